//! A macro that declares an enum by one table of its variants: a new variant needs one new row and nothing else.

/// Declares an enum by a table. Each row holds a variant with its key, its name and its meaning, by which the variant
/// is documented as well. The word behind `by` is the name of the function that returns the key.
macro_rules! described {
    (
        $(#[$attribute:meta])*
        $visibility:vis enum $enum:ident by $key:ident {
            $($variant:ident: $code:literal, $name:literal, $meaning:literal;)*
        }
    ) => {
        $(#[$attribute])*
        $visibility enum $enum {
            $(#[doc = $meaning] $variant,)*
        }

        impl $enum {
            /// All variants, in the order of their table.
            pub const ALL: [Self; [$($code),*].len()] = [$(Self::$variant),*];

            /// Returns the first text of the table.
            pub fn $key(self) -> &'static str {
                match self {
                    $(Self::$variant => $code,)*
                }
            }

            /// Returns the name that menus show.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name,)*
                }
            }

            /// Returns what the name stands for, in whole sentences.
            pub fn meaning(self) -> &'static str {
                match self {
                    $(Self::$variant => $meaning,)*
                }
            }
        }
    };
}

pub(crate) use described;
