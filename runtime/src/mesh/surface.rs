//! Vertices and triangles, and whether they enclose a solid.

use rustc_hash::FxHashMap;

use super::MAX_TRIANGLES;

/// A surface of triangles; counter-clockwise from outside.
#[derive(Clone, Debug, Default)]
pub struct Surface {
    /// Positions.
    pub vertices: Vec<[f32; 3]>,
    /// Three vertices each.
    pub triangles: Vec<[u32; 3]>,
}

impl Surface {
    /// Adds triangles that count vertices from their own first.
    ///
    /// # Errors
    /// A triangle has a vertex that is not there.
    pub fn add(&mut self, vertices: &[[f32; 3]], triangles: &[[u32; 3]]) -> Result<(), String> {
        let first = self.vertices.len() as u32;
        let count = vertices.len() as u32;
        for triangle in triangles {
            if let Some(vertex) = triangle.iter().find(|&&v| v >= count) {
                return Err(format!("a triangle has vertex {vertex} of {count}"));
            }
            self.triangles.push(triangle.map(|v| v + first));
        }
        self.vertices.extend(vertices);
        Ok(())
    }

    /// The surface with equal vertices as one and without triangles that are none, if it is closed.
    ///
    /// # Errors
    /// It is empty, too large, or not closed, or a position is not a number.
    pub fn checked(&self) -> Result<Self, String> {
        let welded = self.welded()?;
        if welded.triangles.is_empty() {
            return Err("there are no triangles in it".to_owned());
        }
        if welded.triangles.len() > MAX_TRIANGLES {
            let count = welded.triangles.len();
            return Err(format!("{count} triangles: at most {MAX_TRIANGLES}"));
        }
        match welded.open_edges() {
            0 => Ok(welded),
            open => Err(format!(
                "it is not closed: {open} of its edges have not one triangle on each side; light inside it has no end there"
            )),
        }
    }

    fn welded(&self) -> Result<Self, String> {
        let mut number: FxHashMap<[u32; 3], u32> = FxHashMap::default();
        let mut out = Self::default();
        let mut new = Vec::with_capacity(self.vertices.len());
        for position in &self.vertices {
            if !position.iter().all(|x| x.is_finite()) {
                return Err(format!("a vertex is at {position:?}"));
            }
            // both zeros are one place
            let key = position.map(|x| (x + 0.0).to_bits());
            let next = out.vertices.len() as u32;
            new.push(*number.entry(key).or_insert(next));
            if number.len() > out.vertices.len() {
                out.vertices.push(*position);
            }
        }
        let place = |v: u32| new[v as usize];
        let real = |t: &[u32; 3]| t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
        out.triangles = self
            .triangles
            .iter()
            .map(|t| t.map(place))
            .filter(real)
            .collect();
        Ok(out)
    }

    /// Edges that are passed through more often one way than the other.
    fn open_edges(&self) -> usize {
        let mut balance: FxHashMap<(u32, u32), i32> = FxHashMap::default();
        for &[a, b, c] in &self.triangles {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                let step = if from < to { 1 } else { -1 };
                *balance.entry((from.min(to), from.max(to))).or_default() += step;
            }
        }
        balance.values().filter(|&&b| b != 0).count()
    }

    /// Six times the volume inside; negative where triangles are clockwise from outside.
    fn volume(&self) -> f64 {
        let place = |v: u32| glam::DVec3::from(self.vertices[v as usize].map(f64::from));
        let of = |&[a, b, c]: &[u32; 3]| place(a).dot(place(b).cross(place(c)));
        self.triangles.iter().map(of).sum()
    }

    /// Scaled evenly and moved so that its box fits -1..1; turned inside out if its volume is negative.
    #[must_use]
    pub fn fitted(&self) -> Self {
        let (low, high) = self.bounds();
        let middle = (low + high) * 0.5;
        let reach = ((high - low) * 0.5).max_element().max(f32::MIN_POSITIVE);
        let fit = |p: &[f32; 3]| ((glam::Vec3::from(*p) - middle) / reach).to_array();
        let inward = self.volume() < 0.0;
        let turned = |&[a, b, c]: &[u32; 3]| if inward { [a, c, b] } else { [a, b, c] };
        Self {
            vertices: self.vertices.iter().map(fit).collect(),
            triangles: self.triangles.iter().map(turned).collect(),
        }
    }

    fn bounds(&self) -> (glam::Vec3, glam::Vec3) {
        let mut low = glam::Vec3::INFINITY;
        let mut high = glam::Vec3::NEG_INFINITY;
        for &position in &self.vertices {
            low = low.min(position.into());
            high = high.max(position.into());
        }
        (low, high)
    }
}
