//! Settings of scenes: what can be said in the braces of a `show`.

use glam::DVec3;

use super::Space;
use crate::numeral::Numeral;

/// What values a setting takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SettingKind {
    /// A real number.
    Real,
    /// A whole number.
    Integer,
    /// A vector of two reals.
    Vec2,
    /// A vector of three reals; one real stands for three equal ones.
    Vec3,
    /// One of these words; the shader gets its place in the list.
    Choice(&'static [&'static str]),
    /// The name of a function of a point of space that gives a real number or a vector of three: a second formula, compiled
    /// into the module.
    Function,
}

/// One setting of a scene.
#[derive(Debug)]
pub struct SettingSpec {
    /// Its name, also that of the member of the template's `Settings`. `center` and `height` of plane scenes are
    /// the view instead.
    pub name: &'static str,
    /// One line with the unit.
    pub doc: &'static str,
    /// What values it takes.
    pub kind: SettingKind,
    /// Value without a setting.
    pub default: DVec3,
    /// Least and greatest value of each component.
    pub range: (f64, f64),
    /// Whether it trades speed for accuracy and leaves what is shown alone: more of it is slower and nearer to the truth; of
    /// words, each is a way to the same picture.
    pub trades: bool,
}

impl SettingSpec {
    /// A real setting.
    #[must_use]
    pub const fn real(
        name: &'static str,
        default: f64,
        range: (f64, f64),
        doc: &'static str,
    ) -> Self {
        Self {
            name,
            doc,
            kind: SettingKind::Real,
            default: DVec3::splat(default),
            range,
            trades: false,
        }
    }

    /// A whole-number setting.
    #[must_use]
    pub const fn integer(
        name: &'static str,
        default: f64,
        range: (f64, f64),
        doc: &'static str,
    ) -> Self {
        Self {
            name,
            doc,
            kind: SettingKind::Integer,
            default: DVec3::splat(default),
            range,
            trades: false,
        }
    }

    /// A setting of three reals.
    #[must_use]
    pub const fn vec3(
        name: &'static str,
        default: [f64; 3],
        range: (f64, f64),
        doc: &'static str,
    ) -> Self {
        Self {
            name,
            doc,
            kind: SettingKind::Vec3,
            default: DVec3::from_array(default),
            range,
            trades: false,
        }
    }

    /// A colour, linear rgb in 0..1.
    #[must_use]
    pub const fn colour(name: &'static str, default: [f64; 3], doc: &'static str) -> Self {
        Self::vec3(name, default, (0.0, 1.0), doc)
    }

    /// A choice of words; the first is the default.
    #[must_use]
    pub const fn choice(
        name: &'static str,
        words: &'static [&'static str],
        default: f64,
        doc: &'static str,
    ) -> Self {
        Self {
            name,
            doc,
            kind: SettingKind::Choice(words),
            default: DVec3::splat(default),
            range: (0.0, f64::INFINITY),
            trades: false,
        }
    }

    /// A function of a point.
    #[must_use]
    pub const fn function(name: &'static str, doc: &'static str) -> Self {
        Self {
            name,
            doc,
            kind: SettingKind::Function,
            default: DVec3::ZERO,
            range: (f64::NEG_INFINITY, f64::INFINITY),
            trades: false,
        }
    }

    /// The same setting, known to trade speed for accuracy.
    #[must_use]
    pub const fn trading(mut self) -> Self {
        self.trades = true;
        self
    }

    /// The centre of the view of a plane scene.
    #[must_use]
    pub const fn center() -> Self {
        Self {
            name: "center",
            doc: "world coordinates of the centre of the picture",
            kind: SettingKind::Vec2,
            default: DVec3::ZERO,
            range: (f64::NEG_INFINITY, f64::INFINITY),
            trades: false,
        }
    }

    /// The height of the view of a plane scene.
    #[must_use]
    pub const fn height(default: f64) -> Self {
        Self::real(
            "height",
            default,
            (1e-30, 1e30),
            "world units from the bottom to the top of the picture",
        )
    }

    /// The colours of the argument of a complex number.
    #[must_use]
    pub const fn wheel(doc: &'static str) -> Self {
        Self::choice(
            "palette",
            &["cubehelix", "oklch", "hsv", "twilight"],
            0.0,
            doc,
        )
    }

    /// The height of the colour key; 0: none. `doc` says what the key shows.
    #[must_use]
    pub const fn key(doc: &'static str) -> Self {
        Self::real("key", 0.0, (0.0, 0.5), doc)
    }

    /// The tier that the formula is computed in; `auto` is left to the host.
    #[must_use]
    pub const fn precision() -> Self {
        Self::choice(
            "precision",
            &["accurate", "fast", "extended", "double", "auto"],
            0.0,
            "how numbers are computed; --precision goes before it",
        )
    }

    /// Says what is wrong with a value, if anything.
    ///
    /// # Errors
    /// A component lies outside of the range, or is not a whole number where one is wanted.
    pub fn check(&self, components: &[f64]) -> Result<(), String> {
        let (lo, hi) = self.range;
        for &x in components {
            if !(lo..=hi).contains(&x) {
                let wanted = match (lo.is_finite(), hi.is_finite()) {
                    (true, false) if lo > 0.0 && lo < 1e-20 => "must be greater than 0".to_owned(),
                    (true, false) => format!("must be at least {}", Numeral(lo)),
                    (false, true) => format!("must be at most {}", Numeral(hi)),
                    _ => format!("must lie between {} and {}", Numeral(lo), Numeral(hi)),
                };
                return Err(format!("`{}` {wanted}, not {}", self.name, Numeral(x)));
            }
            if self.kind == SettingKind::Integer && x.fract() != 0.0 {
                return Err(format!(
                    "`{}` must be a whole number, not {}",
                    self.name,
                    Numeral(x)
                ));
            }
        }
        Ok(())
    }

    /// Whether it says what is seen: of scenes of the plane, the view.
    #[must_use]
    pub fn is_view(&self) -> bool {
        self.kind == SettingKind::Vec2 || self.name == "height"
    }

    /// Whether it is a member of the template's `Settings`: neither the view of the plane nor the precision is, nor a
    /// function.
    #[must_use]
    pub fn is_in_template(&self, space: Space) -> bool {
        !(self.name == "precision"
            || self.is_view() && space != Space::Space
            || self.kind == SettingKind::Function)
    }
}
