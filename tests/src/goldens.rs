//! Small pictures of every scene that are kept as files, and how far another machine's may be from them.
//!
//! The files were drawn on the software adapter. Differences are what is noticed of them by eye (FLIP, mean over the
//! picture); a picture is as it was where that is at most [`CAP`].

use std::path::PathBuf;

use pullback_runtime::difference::{Bitmap, Difference, compare};
use pullback_runtime::{Error, Metadata, Pipeline, Size, image_file};

use crate::corpus::{read, root};
use crate::stills::{Machine, Still};

/// The greatest mean of FLIP between a golden picture and the same picture from another machine. Measured between the
/// software adapter and the executor, `cargo run -p pullback-tests --bin goldens -- --adapter ieee32` (and
/// `reference`): 0.000517 for the special values of `slices` in `ieee32`, where rounding decides which plane is in
/// front; else at most 0.000272, and at most 0.0001 for pictures of the gallery.
pub const CAP: f64 = 0.0006;

/// A picture that is kept: its panels side by side.
#[derive(Clone, Debug)]
pub struct Golden {
    /// Name of the file, without its extension.
    pub name: String,
    /// The programs.
    pub panels: Vec<String>,
    /// Pixels of a panel.
    pub size: Size,
}

/// One file of the gallery for each scene.
const GALLERY: [(&str, &str); 17] = [
    ("levels", "chladni"),
    ("logcontours", "charges"),
    ("bands", "zone-plate"),
    ("implicit", "folium"),
    ("domain", "blaschke"),
    ("checker", "confocal"),
    ("grid", "lambert"),
    ("sphere", "doyle-mcmullen"),
    ("surface", "cayley"),
    ("slices", "multipole"),
    ("nested", "schwarz-family"),
    ("cutaway", "neovius"),
    ("volume", "orbital"),
    ("volumecut", "resonance"),
    ("scatter", "cloud"),
    ("glow", "ember"),
    ("additive", "hologram"),
];

/// Parameters, and values that are undefined, infinite of either sign, and constant.
const PLANE: (&str, [&str; 4]) = (
    "x, y",
    [
        "√(-1 - x²)",
        "1e38 * 1e38 * (1 + x²)",
        "-1e38 * 1e38 * (1 + x²)",
        "0.65",
    ],
);
const COMPLEX: (&str, [&str; 4]) = (
    "z",
    [
        "√(-1 - re(z)²) + z",
        "1e38 * 1e38 * (1 + z conj(z))",
        "-1e38 i * 1e38 * (1 + z conj(z))",
        "0.7 + 0.4i",
    ],
);
const SPACE: (&str, [&str; 4]) = (
    "x, y, z",
    [
        "√(-1 - x²)",
        "1/(x - x + y - y)",
        "-1/(x - x + y - y)",
        "0.7",
    ],
);

/// Every picture that is kept: one of the gallery and one of special values for each scene.
///
/// # Panics
/// A file of the gallery cannot be read.
#[must_use]
pub fn all() -> Vec<Golden> {
    let mut all = Vec::new();
    for (k, (scene, file)) in GALLERY.into_iter().enumerate() {
        let path = root()
            .join("docs/gallery")
            .join(file)
            .with_extension("pull");
        all.push(Golden {
            name: scene.to_owned(),
            panels: vec![read(&path)],
            size: Size {
                width: 160,
                height: 100,
            },
        });
        let (parameters, formulas) = match k {
            0..4 => PLANE,
            4..8 => COMPLEX,
            _ => SPACE,
        };
        let panel = |f| format!("f({parameters}) = {f}\nshow {scene}(f) {{}}");
        all.push(Golden {
            name: format!("{scene}-special"),
            panels: formulas.into_iter().map(panel).collect(),
            size: Size {
                width: 48,
                height: 40,
            },
        });
    }
    let medium = |f: &str, scene: &str, settings: &str| {
        format!("f(x, y, z) = {f}\nshow {scene}(f) {{ {settings} }}")
    };
    all.push(Golden {
        name: "columns".to_owned(),
        panels: vec![
            medium(
                "max(0, 1 - x^2 - y^2/2 - z^2)",
                "volume",
                "power = 1, signs = positive, emission = even",
            ),
            medium(
                "sin(3 x) cos(2 y) + z/2",
                "volume",
                "steps_by = integral, steps = 24",
            ),
            medium(
                "exp(-2 (z + 2)) + 3 exp(-4 (x^2 + y^2 + z^2))",
                "scatter",
                "steps_by = integral, steps = 24",
            ),
            medium(
                "√x",
                "volume",
                "power = 1, signs = positive, emission = even",
            ),
        ],
        size: Size {
            width: 48,
            height: 40,
        },
    });
    all
}

impl Golden {
    /// The file.
    #[must_use]
    pub fn path(&self) -> PathBuf {
        let folder = root().join("tests/data/goldens");
        folder.join(&self.name).with_extension("png")
    }

    /// The panels, with a change of their settings.
    #[must_use]
    pub fn stills(&self, mut change: impl FnMut(&mut Still)) -> Vec<Still> {
        let mut stills = Vec::new();
        for panel in &self.panels {
            let mut still = Still::new(panel, self.size, 2);
            change(&mut still);
            stills.push(still);
        }
        stills
    }

    /// The whole picture from a machine.
    ///
    /// # Errors
    /// The machine's.
    pub fn draw(&self, stills: &[Still], machine: &Machine) -> Result<Bitmap, Error> {
        let drawn = stills
            .iter()
            .map(|still| still.draw(machine, Pipeline::Compute))
            .collect::<Result<Vec<_>, _>>()?;
        let line = self.size.width as usize * 4;
        let rows = (0..self.size.height as usize).flat_map(|y| {
            let part = move |panel: &Vec<u8>| panel[y * line..(y + 1) * line].to_vec();
            drawn.iter().flat_map(part)
        });
        Bitmap::from_rgba(self.whole(), &rows.collect::<Vec<u8>>())
    }

    /// Pixels of all panels together.
    fn whole(&self) -> Size {
        Size {
            width: self.size.width * self.panels.len() as u32,
            ..self.size
        }
    }

    /// How a picture differs from the one that is kept.
    ///
    /// # Errors
    /// The file cannot be read, or has another size.
    pub fn difference(&self, picture: &Bitmap) -> Result<Difference, Error> {
        let kept = Bitmap::read_png(&self.path())?;
        compare(&kept, picture, &mut |_, _| ())
    }

    /// Keeps a picture.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn keep(&self, picture: &Bitmap) -> Result<(), Error> {
        let rgba: Vec<u8> = picture
            .pixels()
            .iter()
            .flat_map(|&[r, g, b]| [r, g, b, u8::MAX])
            .collect();
        image_file::write_png(
            &self.path(),
            picture.size(),
            &Metadata(Vec::new()),
            |sink| Ok(sink.rows(&rgba)?),
        )
    }
}
