//! The camera of scenes of space in f64, as the settings describe it.

pub type Vec3 = [f64; 3];

pub fn add(a: Vec3, b: Vec3, factor: f64) -> Vec3 {
    [0, 1, 2].map(|k| a[k] + factor * b[k])
}

pub fn dot(a: Vec3, b: Vec3) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}

pub fn unit(a: Vec3) -> Vec3 {
    let length = dot(a, a).sqrt();
    a.map(|x| x / length)
}

/// A camera that looks at the origin.
#[derive(Clone, Copy, Debug)]
pub struct Camera {
    /// Degrees.
    pub yaw: f64,
    pub pitch: f64,
    pub fov: f64,
    pub distance: f64,
    /// Pixels.
    pub size: [u32; 2],
}

#[derive(Clone, Copy, Debug)]
pub struct Ray {
    pub origin: Vec3,
    /// Of length 1.
    pub direction: Vec3,
}

impl Ray {
    pub fn at(&self, t: f64) -> Vec3 {
        add(self.origin, self.direction, t)
    }

    /// Distance to the plane n·p = offset.
    pub fn plane(&self, n: Vec3, offset: f64) -> f64 {
        (offset - dot(n, self.origin)) / dot(n, self.direction)
    }

    /// Where it is inside of the cube |x|, |y|, |z| ≤ half.
    pub fn cube(&self, half: f64) -> Option<[f64; 2]> {
        let mut span = [f64::NEG_INFINITY, f64::INFINITY];
        for k in 0..3 {
            let mut ends = [-half, half].map(|wall| (wall - self.origin[k]) / self.direction[k]);
            ends.sort_by(f64::total_cmp);
            span = [span[0].max(ends[0]), span[1].min(ends[1])];
        }
        (span[0] < span[1]).then_some(span)
    }
}

impl Camera {
    /// World units of a pixel at the distance of the origin.
    pub fn pixel(&self) -> f64 {
        let [width, height] = self.size.map(f64::from);
        2.0 * (0.5 * self.fov.to_radians()).tan() / width.min(height) * self.distance
    }

    /// The ray through a point of the image, y down.
    pub fn ray(&self, x: f64, y: f64) -> Ray {
        let (yaw, pitch) = (self.yaw.to_radians(), self.pitch.to_radians());
        let back = [
            pitch.cos() * yaw.cos(),
            pitch.cos() * yaw.sin(),
            pitch.sin(),
        ];
        let right = [-yaw.sin(), yaw.cos(), 0.0];
        let up = [
            -pitch.sin() * yaw.cos(),
            -pitch.sin() * yaw.sin(),
            pitch.cos(),
        ];
        let [width, height] = self.size.map(f64::from);
        let slope = 2.0 * (0.5 * self.fov.to_radians()).tan() / width.min(height);
        let direction = add(
            add(back.map(|b| -b), right, slope * (x - 0.5 * width)),
            up,
            -slope * (y - 0.5 * height),
        );
        Ray {
            origin: back.map(|b| b * self.distance),
            direction: unit(direction),
        }
    }

    /// As settings of a scene.
    pub fn settings(&self) -> String {
        format!(
            "yaw = {}, pitch = {}, fov = {}, distance = {}",
            self.yaw, self.pitch, self.fov, self.distance
        )
    }
}
