//! Rays of every kind that may make a closed form fail.

/// How the direction of a ray is special.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Slant {
    /// No component is small.
    General,
    /// The least component that is not 0 is near 10 to this, -8 to -1.
    Decade(i8),
    /// It is near 1e-12, 1e-20 or 1e-30.
    Tiny,
    /// It is denormal.
    Denormal,
    /// A component is 0, and no other is small.
    Zero,
}

impl Slant {
    /// Every kind.
    #[must_use]
    pub fn all() -> Vec<Self> {
        let decades = (1..=8).map(|k| Self::Decade(-k));
        std::iter::once(Self::General)
            .chain(decades)
            .chain([Self::Tiny, Self::Denormal, Self::Zero])
            .collect()
    }

    /// As it is told.
    #[must_use]
    pub fn name(self) -> String {
        match self {
            Self::General => "none small".to_owned(),
            Self::Decade(n) => format!("1e{n}"),
            Self::Tiny => "1e-12 … 1e-30".to_owned(),
            Self::Denormal => "denormal".to_owned(),
            Self::Zero => "0".to_owned(),
        }
    }
}

/// Where a ray begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Distance {
    /// Within 10 units of the centre of the scene.
    Near,
    /// 100 units away, on a ray that passes the scene.
    Hundred,
    /// From 1000 to a million units away, on a ray that passes the scene.
    Far,
}

/// A ray o + t d from t = a to t = b, of numbers that binary32 holds.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    /// o, d, a, b.
    pub numbers: [f64; 8],
    /// Of its direction.
    pub slant: Slant,
    /// Of its origin.
    pub distance: Distance,
}

/// The generator of Knuth's MMIX.
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, lo: f64, hi: f64) -> f64 {
        lo + (hi - lo) * self.unit()
    }

    /// 10 to something between.
    fn power(&mut self, lo: f64, hi: f64) -> f64 {
        10_f64.powf(self.between(lo, hi))
    }

    fn sign(&mut self) -> f64 {
        if self.unit() < 0.5 { -1.0 } else { 1.0 }
    }

    fn of(&mut self, count: usize) -> usize {
        (self.unit() * count as f64) as usize
    }

    /// A direction of length 1.
    fn direction(&mut self) -> [f64; 3] {
        loop {
            let v: [f64; 3] = std::array::from_fn(|_| self.between(-1.0, 1.0));
            let size = v.iter().map(|x| x * x).sum::<f64>().sqrt();
            if size < 1.0 && v.iter().all(|x| x.abs() > 0.2 * size) {
                return v.map(|x| x / size);
            }
        }
    }
}

fn single(x: f64) -> f64 {
    f64::from(x as f32)
}

/// As many rays; the same for the same seed.
#[must_use]
pub fn rays(count: usize, seed: u64) -> Vec<Ray> {
    let mut random = Random(seed);
    (0..100).for_each(|_| _ = random.unit());
    (0..count).map(|k| ray(&mut random, k)).collect()
}

fn ray(random: &mut Random, k: usize) -> Ray {
    let (d, slant) = direction(random);
    let distance = match k % 10 {
        0..7 => Distance::Near,
        7..9 => Distance::Hundred,
        _ => Distance::Far,
    };
    let length = if random.unit() < 0.6 {
        random.power(-7.0, 4.0)
    } else {
        random.between(0.0, 6.0)
    };
    let (o, a) = if distance == Distance::Near && random.unit() < 0.5 {
        let size = random.power(-3.0, 1.0) / 3_f64.sqrt();
        let o = std::array::from_fn(|_| random.between(-size, size));
        (o, random.between(-3.0, 3.0))
    } else {
        let away = match distance {
            Distance::Near => random.between(0.0, 9.0),
            Distance::Hundred => 100.0,
            Distance::Far => random.power(3.0, 6.0),
        };
        aimed(random, d, away, length)
    };
    let mut ends = [a, a + length];
    if random.unit() < 0.1 {
        ends.swap(0, 1);
    }
    let numbers = [o[0], o[1], o[2], d[0], d[1], d[2], ends[0], ends[1]];
    Ray {
        numbers: numbers.map(single),
        slant,
        distance,
    }
}

/// An origin from which the ray passes the centre at a distance of 1e-8 to 1, or through it, and a begin for which the
/// nearest place is in the interval or beside it.
fn aimed(random: &mut Random, d: [f64; 3], away: f64, length: f64) -> ([f64; 3], f64) {
    let miss = if random.unit() < 0.05 {
        0.0
    } else {
        random.power(-8.0, 0.3)
    };
    let aside = random.direction();
    let size = d.iter().map(|x| x * x).sum::<f64>().sqrt();
    // where the direction is tiny the interval cannot reach the scene, and the origin is in it
    let at = if size > 0.1 { away / size } else { 0.0 };
    let o = std::array::from_fn(|c| miss * aside[c] - at * d[c]);
    (o, at - length * random.between(-0.5, 1.5))
}

/// A direction some of whose components are special.
fn direction(random: &mut Random) -> ([f64; 3], Slant) {
    let mut d = random.direction();
    let mut slant = Slant::General;
    if random.unit() < 0.2 {
        return (d, slant);
    }
    let first = random.of(3);
    let count = [1, 1, 1, 2, 2, 3][random.of(6)];
    for k in 0..count {
        let (size, kind) = match random.of(12) {
            0 | 1 => (0.0, Slant::Zero),
            2 => (1e-40, Slant::Denormal),
            3 => ([1e-12, 1e-20, 1e-30][random.of(3)], Slant::Tiny),
            n => (10_f64.powi(3 - n as i32), Slant::Decade(3 - n as i8)),
        };
        d[(first + k) % 3] = size * random.sign() * random.between(1.0, 2.0);
        slant = if k == 0 || slant == Slant::Zero {
            kind
        } else if kind == Slant::Zero {
            slant
        } else {
            smaller(slant, kind)
        };
    }
    (d, slant)
}

fn smaller(a: Slant, b: Slant) -> Slant {
    match (a, b) {
        (Slant::Decade(m), Slant::Decade(n)) => Slant::Decade(m.min(n)),
        _ => a.max(b),
    }
}

impl Ray {
    /// The same ray with its origin moved, in f64, to the place of the interval that is nearest to the centre of the scene: its
    /// numbers in binary32, and what the origin and both ends are beyond them.
    #[must_use]
    pub fn shifted(&self) -> (Self, [f64; 5]) {
        let n = self.numbers;
        let (mut along, mut square) = (0.0, 0.0);
        for c in 0..3 {
            along += n[c] * n[3 + c];
            square += n[3 + c] * n[3 + c];
        }
        let foot = if square > 0.0 { -along / square } else { 0.0 };
        let t = foot.clamp(n[6].min(n[7]), n[6].max(n[7]));
        let mut out = *self;
        let mut rests = [0.0; 5];
        let mut put = |k: usize, rest: usize, x: f64| {
            out.numbers[k] = single(x);
            rests[rest] = single(x - out.numbers[k]);
        };
        for c in 0..3 {
            put(c, c, t.mul_add(n[3 + c], n[c]));
        }
        put(6, 3, n[6] - t);
        put(7, 4, n[7] - t);
        (out, rests)
    }

    /// The place at t.
    #[must_use]
    pub fn at(&self, t: f64) -> [f64; 3] {
        std::array::from_fn(|c| t.mul_add(self.numbers[3 + c], self.numbers[c]))
    }
}
