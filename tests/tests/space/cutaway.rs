//! `cutaway`: the cut has the values of its plane, nothing is seen on the side that is cut away, and the layers behind the
//! cut are composited with it.

use pullback_runtime::Gpu;

use crate::camera::{Ray, Vec3, add, dot, unit};
use crate::colour::{Rgb, diverging, encoded};
use crate::drawing::{device, draw};
use crate::nested::{CAMERA, Family, Quadric, composited};

/// A family, and the plane that cuts it.
struct Cut {
    family: Family,
    normal: Vec3,
    position: f64,
    /// Opacity of the cut where f < level, and where f > level.
    opacity: [f64; 2],
}

/// What a ray meets: distance, kind (a level, or 1000 and 1001 for the cut), colour and opacity.
type Layers = Vec<(f64, usize, Rgb, f64)>;

impl Cut {
    fn source(&self) -> String {
        let [a, b, c] = self.normal;
        format!(
            "f(x, y, z) = {}\nshow cutaway(f) {{ normal = ({a}, {b}, {c}), position = {}, color_scale = 1.5, \
             cut_below = {}, cut_above = {}, line_opacity = 0, level_width = 0, {} }}",
            self.family.quadric.formula(),
            self.position,
            self.opacity[0],
            self.opacity[1],
            self.family.settings()
        )
    }

    /// The layers of a ray, from the front; none on the side of the plane that the normal points to.
    fn layers(&self, ray: &Ray) -> Layers {
        let Some([near, far]) = ray.cube(2.0) else {
            return Vec::new();
        };
        let n = unit(self.normal);
        let offset = self.position * n.iter().map(|c| 2.0 * c.abs()).sum::<f64>();
        let t = ray.plane(n, offset);
        let kept = if dot(n, ray.direction) < 0.0 {
            [near.max(t), far]
        } else {
            [near, far.min(t)]
        };
        let mut layers = self.family.layers(ray, kept);
        if t > near && t < far {
            let value = self.family.quadric.value(ray.at(t)) - self.family.level;
            let above = usize::from(value >= 0.0);
            let colour = diverging(value / value.hypot(1.5));
            layers.push((t, 1000 + above, colour, self.opacity[above]));
            layers.sort_by(|a, b| a.0.total_cmp(&b.0));
        }
        layers
    }
}

fn check(gpu: &Gpu, cut: &Cut) {
    let picture = draw(gpu, &cut.source(), CAMERA.size, 2, 0.0);
    let kinds = |layers: &Layers| layers.iter().map(|l| l.1).collect::<Vec<_>>();
    let (mut compared, mut cuts) = (0, 0);
    for y in 0..CAMERA.size[1] {
        for x in 0..CAMERA.size[0] {
            // the mean over the pixel, which a silhouette must not cross
            let place = |j: u32| (f64::from(j) + 0.5) / 4.0;
            let at = |k: u32| {
                cut.layers(&CAMERA.ray(f64::from(x) + place(k % 4), f64::from(y) + place(k / 4)))
            };
            let here = at(0);
            if (1..16).any(|k| kinds(&at(k)) != kinds(&here)) {
                continue;
            }
            let mean = (0..16).fold([0.0; 3], |sum, k| {
                add(sum, composited(&at(k), [0.1, 0.4, 0.2]), 1.0 / 16.0)
            });
            let wanted = mean.map(|c| encoded(c.clamp(0.0, 1.0)));
            let found = picture.srgb(x, y);
            for k in 0..3 {
                assert!(
                    (found[k] - wanted[k]).abs() < 2.0 / 255.0,
                    "{}, pixel {x}, {y}: {found:?}, not {wanted:?} of {:?}",
                    cut.source(),
                    kinds(&here)
                );
            }
            compared += 1;
            cuts += usize::from(here.iter().any(|l| l.1 >= 1000));
        }
    }
    println!(
        "{}: {compared} pixels, {cuts} of the cut",
        cut.family.quadric.formula()
    );
    assert!(compared > 4000 && cuts > 500, "{compared}, {cuts}");
}

#[test]
fn the_cut_and_the_layers_behind_it_are_where_they_have_to_be() {
    let Some(gpu) = device() else { return };
    let family = |quadric, level| Family {
        quadric: Quadric(quadric),
        level,
        spacing: 0.6,
        count: 5,
        highlight: 3,
        highlight_opacity: 0.9,
        ghost_opacity: 0.3,
    };
    for (quadric, level, normal, position, opacity) in [
        // towards the camera, away from it, and across
        (
            [1.0, 1.0, 1.0, 0.0, 0.0, 0.0],
            2.0,
            [1.0, 0.0, 0.0],
            0.1,
            [1.0, 0.3],
        ),
        (
            [0.3, 0.0, 0.0, 0.0, 1.0, 0.5],
            0.1,
            [-1.0, 0.3, -0.5],
            0.2,
            [0.6, 0.4],
        ),
        (
            [1.0, 1.0, -1.0, 0.0, 0.0, 0.0],
            0.2,
            [0.2, -1.0, -0.6],
            -0.1,
            [0.8, 0.0],
        ),
    ] {
        check(
            &gpu,
            &Cut {
                family: family(quadric, level),
                normal,
                position,
                opacity,
            },
        );
    }
}
