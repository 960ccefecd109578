//! Unpacks buffer views that EXT_meshopt_compression has packed, as its specification describes (Khronos, 2021): bytes of
//! attributes as differences from corner to corner, triangles by the edges and corners that came before.

use brillianteer_base::Fault;

/// The name of the extension.
pub(super) const NAME: &str = "EXT_meshopt_compression";

/// The number of corners that are packed together within a block.
const GROUP: usize = 16;

/// The second numbers of a triangle by the last four bits of its code, where those bits choose one of the frequent ones, lie
/// in the last bytes of the packed triangles.
const TABLE: usize = 16;

/// A packed buffer view.
#[derive(Debug, Clone, Copy)]
pub(super) struct Packed<'a> {
    pub bytes: &'a [u8],
    pub count: usize,
    pub stride: usize,
    pub mode: &'a str,
    pub filter: &'a str,
}

impl Packed<'_> {
    /// Returns the `count` times `stride` bytes of the view.
    ///
    /// # Errors
    /// Fails where the bytes end too soon, or are packed in another way than the extension's.
    pub fn unpacked(self) -> Result<Vec<u8>, Fault> {
        let found = match (self.mode, self.stride) {
            ("ATTRIBUTES", 4..=256) if self.stride.is_multiple_of(4) => self.attributes(),
            ("TRIANGLES", 2 | 4) if self.count.is_multiple_of(3) => self.triangles(),
            ("INDICES", 2 | 4) => self.indices(),
            _ => None,
        };
        let mut bytes = found.ok_or_else(|| {
            format!(
                "its {} bytes of {NAME} ({}) cannot be unpacked; save the file without it",
                self.bytes.len(),
                self.mode
            )
        })?;
        match self.filter {
            "EXPONENTIAL" => bytes.as_chunks_mut::<4>().0.iter_mut().for_each(exponential),
            "" | "NONE" => {}
            // The directions that these hold are not read.
            "OCTAHEDRAL" | "QUATERNION" => {}
            other => {
                return Err(
                    format!("the filter {other} of {NAME} is not known; save the file without it").into()
                );
            }
        }
        Ok(bytes)
    }

    fn attributes(self) -> Option<Vec<u8>> {
        let Self { bytes, count, stride, .. } = self;
        let mut reader = Bytes { rest: bytes.get(..bytes.len().checked_sub(stride.max(32))?)? };
        if reader.byte()? != 0xa0 {
            return None;
        }
        let mut last = bytes[bytes.len() - stride..].to_vec();
        let mut unpacked = vec![0; count.checked_mul(stride)?];
        let block = ((8192 / stride) & !(GROUP - 1)).min(256);
        for block in unpacked.chunks_mut(block * stride) {
            for (byte, last) in last.iter_mut().enumerate() {
                let groups = (block.len() / stride).div_ceil(GROUP);
                let modes = reader.take(groups.div_ceil(4))?;
                for group in 0..groups {
                    let mode = modes[group / 4] >> (2 * (group % 4)) & 3;
                    for (place, delta) in reader.group(mode)?.into_iter().enumerate() {
                        *last = last.wrapping_add((delta >> 1) ^ (delta & 1).wrapping_neg());
                        let Some(to) = block.get_mut((GROUP * group + place) * stride + byte) else { break };
                        *to = *last;
                    }
                }
            }
        }
        Some(unpacked)
    }

    fn triangles(self) -> Option<Vec<u8>> {
        let Self { bytes, count, stride, .. } = self;
        let (body, table) = bytes.split_at_checked(bytes.len().checked_sub(TABLE)?)?;
        let mut reader = Bytes { rest: body };
        if reader.byte()? != 0xe1 {
            return None;
        }
        let mut codes = Bytes { rest: reader.take(count / 3)? };
        let mut strip = Strip::default();
        let mut unpacked = Vec::with_capacity(count * stride);
        for _ in 0..count / 3 {
            let triangle = strip.next(codes.byte()?, &mut reader, table)?;
            triangle.iter().for_each(|corner| unpacked.extend(&corner.to_le_bytes()[..stride]));
        }
        Some(unpacked)
    }

    fn indices(self) -> Option<Vec<u8>> {
        let Self { bytes, count, stride, .. } = self;
        let mut reader = Bytes { rest: bytes.get(..bytes.len().checked_sub(4)?)? };
        if reader.byte()? != 0xd1 {
            return None;
        }
        let mut last = [0_u32; 2];
        let mut unpacked = Vec::with_capacity(count.min(bytes.len()).checked_mul(stride)?);
        for _ in 0..count {
            let number = reader.number()?;
            let own = &mut last[(number & 1) as usize];
            *own = own.wrapping_add(signed(number >> 1));
            unpacked.extend(&own.to_le_bytes()[..stride]);
        }
        Some(unpacked)
    }
}

/// Returns the number that zigzag coding writes as another: 0, -1, 1, -2 and so on.
fn signed(number: u32) -> u32 {
    number >> 1 ^ (number & 1).wrapping_neg()
}

/// Replaces an exponent of 8 bits above a mantissa of 24 by the f32 that they make.
fn exponential(bytes: &mut [u8; 4]) {
    let packed = i32::from_le_bytes(*bytes);
    let (exponent, mantissa) = (packed >> 24, (packed << 8) >> 8);
    *bytes = ((f64::from(mantissa) * f64::from(exponent).exp2()) as f32).to_le_bytes();
}

/// The packed bytes that are left.
struct Bytes<'a> {
    rest: &'a [u8],
}

impl<'a> Bytes<'a> {
    fn take(&mut self, count: usize) -> Option<&'a [u8]> {
        let (taken, rest) = self.rest.split_at_checked(count)?;
        self.rest = rest;
        Some(taken)
    }

    fn byte(&mut self) -> Option<u8> {
        self.take(1).map(|taken| taken[0])
    }

    /// Reads a number of up to 32 bits, seven in each byte, the lowest first.
    fn number(&mut self) -> Option<u32> {
        let mut number = 0;
        for shift in [0, 7, 14, 21, 28] {
            let byte = self.byte()?;
            number |= u32::from(byte & 0x7f) << shift;
            if byte < 0x80 {
                return Some(number);
            }
        }
        None
    }

    /// Reads the differences of a group: none, or of 2, 4 or 8 bits, where all bits set mean that a byte of its own follows.
    fn group(&mut self, mode: u8) -> Option<[u8; GROUP]> {
        let bits = match mode {
            0 => return Some([0; GROUP]),
            1 => 2,
            2 => 4,
            _ => return self.take(GROUP)?.try_into().ok(),
        };
        let packed = self.take(GROUP * bits / 8)?;
        let mut deltas = [0; GROUP];
        for (place, delta) in deltas.iter_mut().enumerate() {
            let at = place * bits;
            let most = (1 << bits) - 1;
            *delta = packed[at / 8] >> (8 - bits - at % 8) & most;
            if *delta == most {
                *delta = self.byte()?;
            }
        }
        Some(deltas)
    }
}

/// The edges and corners that the next triangle may take from those before, the latest first.
#[derive(Default)]
struct Strip {
    edges: [[u32; 2]; 16],
    corners: [u32; 16],
    /// The number of the next corner that no triangle had yet.
    next: u32,
    /// The last corner that was given by its own number.
    last: u32,
}

impl Strip {
    fn next(&mut self, code: u8, rest: &mut Bytes<'_>, table: &[u8]) -> Option<[u32; 3]> {
        let (high, low) = (usize::from(code >> 4), code & 15);
        if high < 15 {
            let [a, b] = self.edges[high];
            let c = match low {
                0 => self.fresh(),
                1..13 => self.corners[usize::from(low)],
                13 | 14 => {
                    self.last = if low == 13 { self.last.wrapping_sub(1) } else { self.last.wrapping_add(1) };
                    self.last
                }
                _ => self.given(rest)?,
            };
            if !(1..13).contains(&low) {
                self.push_corner(c);
            }
            self.push_edges([[c, b], [a, c]]);
            return Some([a, b, c]);
        }
        let pair = if low < 14 { table[usize::from(low)] } else { rest.byte()? };
        if low >= 14 && pair == 0 {
            self.next = 0;
        }
        // A table never gives a corner by its own number, which 15 means.
        let codes = [if low == 15 { 15 } else { 0 }, pair >> 4, pair & 15];
        let before = self.corners;
        let mut triangle = [0; 3];
        for (corner, code) in triangle.iter_mut().zip(codes) {
            *corner = match code {
                0 => self.fresh(),
                15 => 0,
                code => before[usize::from(code) - 1],
            };
        }
        for (corner, _) in triangle.iter_mut().zip(codes).filter(|(_, code)| *code == 15) {
            *corner = self.given(rest)?;
        }
        for (&corner, _) in triangle.iter().zip(codes).filter(|(_, code)| matches!(code, 0 | 15)) {
            self.push_corner(corner);
        }
        let [a, b, c] = triangle;
        self.push_edges([[b, a], [c, b], [a, c]]);
        Some(triangle)
    }

    fn fresh(&mut self) -> u32 {
        self.next = self.next.wrapping_add(1);
        self.next.wrapping_sub(1)
    }

    fn given(&mut self, rest: &mut Bytes<'_>) -> Option<u32> {
        self.last = self.last.wrapping_add(signed(rest.number()?));
        Some(self.last)
    }

    fn push_corner(&mut self, corner: u32) {
        self.corners.rotate_right(1);
        self.corners[0] = corner;
    }

    fn push_edges<const N: usize>(&mut self, edges: [[u32; 2]; N]) {
        for edge in edges {
            self.edges.rotate_right(1);
            self.edges[0] = edge;
        }
    }
}
