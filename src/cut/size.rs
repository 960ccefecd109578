//! temp
#[derive(Debug, Clone, Copy)]
pub enum Size {
    #[allow(missing_docs)]
    Mm(f64),
}
impl std::str::FromStr for Size {
    type Err = String;
    fn from_str(s: &str) -> Result<Self, String> {
        s.parse().map(Size::Mm).map_err(|_| "x".into())
    }
}
