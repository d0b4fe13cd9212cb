//! Types of the language.

use std::fmt;

/// Type of a value in the language.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Type {
    /// A real number.
    Real,
    /// A complex number.
    Complex,
    /// A vector of two to four reals.
    Vector(u8),
    /// A truth value.
    Bool,
}

impl Type {
    /// The type that an annotation names.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Some(match name {
            "real" => Self::Real,
            "complex" => Self::Complex,
            "vec2" => Self::Vector(2),
            "vec3" => Self::Vector(3),
            "vec4" => Self::Vector(4),
            "bool" => Self::Bool,
            _ => return None,
        })
    }

    /// The type in words, with its article: "a real number".
    #[must_use]
    pub fn in_words(self) -> &'static str {
        match self {
            Self::Real => "a real number",
            Self::Complex => "a complex number",
            Self::Vector(2) => "a vec2",
            Self::Vector(3) => "a vec3",
            Self::Vector(_) => "a vec4",
            Self::Bool => "a condition",
        }
    }

    /// Number of real columns that a value has in tables.
    #[must_use]
    pub fn columns(self) -> usize {
        match self {
            Self::Real | Self::Bool => 1,
            Self::Complex => 2,
            Self::Vector(n) => usize::from(n),
        }
    }
}

impl fmt::Display for Type {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Real => f.write_str("real"),
            Self::Complex => f.write_str("complex"),
            Self::Vector(n) => write!(f, "vec{n}"),
            Self::Bool => f.write_str("bool"),
        }
    }
}
