//! Mutations of texts, by tokens and by bytes; deterministic.

/// A small generator of pseudo-random numbers (xorshift64*, Vigna 2016).
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// A generator; equal seeds give equal numbers.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        // SplitMix64, so that neighbouring seeds differ
        let mut z = seed.wrapping_add(0x9E37_79B9_7F4A_7C15);
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        Self((z ^ (z >> 31)) | 1)
    }

    /// The next number.
    pub fn next_u64(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_F491_4F6C_DD1D)
    }

    /// A number below `bound`; 0 where that is 0.
    pub fn below(&mut self, bound: usize) -> usize {
        let bound = u64::try_from(bound).unwrap_or(u64::MAX).max(1);
        usize::try_from(self.next_u64() % bound).unwrap_or(0)
    }

    /// One of these.
    ///
    /// # Panics
    /// There is none.
    pub fn pick<'t, T>(&mut self, of: &'t [T]) -> &'t T {
        &of[self.below(of.len())]
    }
}

/// What is inserted: every sign and word of the language, and what people write instead.
const TOKENS: [&str; 182] = [
    "(",
    ")",
    "{",
    "}",
    "|",
    "||",
    "[",
    "]",
    ",",
    ";",
    ":",
    ".",
    "..",
    "…",
    "=",
    "==",
    "!=",
    "<",
    "<=",
    ">",
    ">=",
    "≤",
    "≥",
    "≠",
    "+",
    "-",
    "*",
    "/",
    "^",
    "**",
    "!",
    "√",
    "·",
    "×",
    "÷",
    "−",
    "²",
    "³",
    "⁻¹",
    "₀",
    "'",
    "\"",
    "&&",
    "∧",
    "∨",
    "¬",
    "?",
    "%",
    "&",
    "~",
    "$",
    "#",
    "//",
    "/*",
    "*/",
    "\n",
    "\r\n",
    "\t",
    " ",
    "\u{FEFF}",
    "\0",
    "param",
    "in",
    "where",
    "show",
    "if",
    "then",
    "else",
    "and",
    "or",
    "not",
    "true",
    "false",
    "x",
    "y",
    "z",
    "p",
    "f",
    "g",
    "a",
    "k",
    "π",
    "τ",
    "φ",
    "θ",
    "e",
    "i",
    "2i",
    "inf",
    "nan",
    "∞",
    "time",
    "pixel",
    "0",
    "1",
    "2",
    "0.5",
    "1e-3",
    "1e308",
    "1e999",
    "3.",
    ".5",
    "1_0",
    "2e",
    "sin",
    "gamma",
    "log",
    "max",
    "mod",
    "atan2",
    "clamp",
    "mix",
    "length",
    "vec3",
    "dot",
    "rotate",
    "sum",
    "grad",
    "diff",
    "xy",
    "real",
    "complex",
    "vec2",
    "bool",
    "levels",
    "domain",
    "surface",
    "cutaway",
    "volume",
    "height",
    "iterate",
    "product",
    "integral",
    "until",
    "np.",
    "math.",
    "std::",
    "np.where(",
    "Math.PI",
    "float",
    "let",
    "return",
    "lambda x:",
    "def f(x):",
    "const",
    "=>",
    "->",
    "+=",
    ":=",
    "vec3<f32>",
    "2.0f",
    "3j",
    "Sin[",
    "f[x_]",
    "_",
    "_{",
    "^{",
    "\\",
    "\\\\",
    "\\,",
    "\\sin",
    "\\log_2",
    "\\frac",
    "\\sqrt",
    "\\sqrt[",
    "\\pi",
    "\\phi",
    "\\cdot",
    "\\left(",
    "\\right)",
    "\\left|",
    "\\right|",
    "\\mathrm{",
    "\\text{",
    "\\operatorname{",
    "\\bar",
    "\\sum_{k=1}^{",
    "\\int_0^1",
    "dx",
    "\\begin{cases}",
    "\\end{cases}",
    "\\le",
];

/// A text as pieces: words, numbers, blanks, and single signs.
#[must_use]
pub fn pieces(text: &str) -> Vec<String> {
    #[derive(PartialEq)]
    enum Kind {
        Word,
        Blank,
        Sign,
    }
    let kind = |c: char| match c {
        _ if c.is_alphanumeric() || c == '_' => Kind::Word,
        ' ' => Kind::Blank,
        _ => Kind::Sign,
    };
    let mut out: Vec<String> = Vec::new();
    let mut last = Kind::Sign;
    for c in text.chars() {
        let now = kind(c);
        match out.last_mut() {
            Some(piece) if now != Kind::Sign && now == last => piece.push(c),
            _ => out.push(c.into()),
        }
        last = now;
    }
    out
}

/// Greatest length of what [`mutated`] gives, in bytes, about.
const LONGEST: usize = 20_000;

/// One of the texts, changed in a few places; sometimes joined with another.
#[must_use]
pub fn mutated(corpus: &[String], random: &mut Random) -> Vec<u8> {
    let mut text = random.pick(corpus).clone();
    if random.below(4) == 0 {
        let other = random.pick(corpus);
        text = joined(&text, other, random);
    }
    let mut tokens = pieces(&text);
    // a text with few changes is read to its end more often
    let most = *random.pick(&[1, 2, 6]);
    for _ in 0..=random.below(most) {
        change_tokens(&mut tokens, random);
    }
    let mut bytes = tokens.concat().into_bytes();
    if random.below(5) == 0 {
        for _ in 0..=random.below(4) {
            change_bytes(&mut bytes, random);
        }
    }
    bytes.truncate(LONGEST);
    bytes
}

/// Some lines of both.
fn joined(one: &str, other: &str, random: &mut Random) -> String {
    let mut lines: Vec<&str> = one.lines().collect();
    for line in other.lines() {
        let at = random.below(lines.len() + 1);
        if random.below(2) == 0 {
            lines.insert(at, line);
        }
    }
    lines.join("\n")
}

fn change_tokens(tokens: &mut Vec<String>, random: &mut Random) {
    let at = random.below(tokens.len());
    let new = (*random.pick(&TOKENS)).to_owned();
    if tokens.is_empty() {
        tokens.push(new);
        return;
    }
    match random.below(9) {
        0 | 1 => tokens.insert(at, new),
        2 | 3 => tokens[at] = new,
        4 => {
            tokens.remove(at);
        }
        5 => {
            let other = random.below(tokens.len());
            tokens.swap(at, other);
        }
        6 => {
            let copy = tokens[at].clone();
            let to = random.below(tokens.len());
            tokens.insert(to, copy);
        }
        7 => {
            // a run of pieces again, elsewhere
            let end = (at + 1 + random.below(12)).min(tokens.len());
            let run: Vec<String> = tokens[at..end].to_vec();
            let to = random.below(tokens.len());
            tokens.splice(to..to, run);
        }
        _ => {
            let times = [2, 3, 10, 70, 250, 1000][random.below(6)];
            let piece = tokens[at].repeat(times);
            if piece.len() < LONGEST {
                tokens[at] = piece;
            }
        }
    }
}

fn change_bytes(bytes: &mut Vec<u8>, random: &mut Random) {
    let at = random.below(bytes.len());
    let new = u8::try_from(random.below(256)).unwrap_or(0);
    if bytes.is_empty() {
        bytes.push(new);
        return;
    }
    match random.below(4) {
        0 => bytes[at] = new,
        1 => bytes.insert(at, new),
        2 => {
            bytes.remove(at);
        }
        _ => bytes[at] ^= 1 << random.below(8),
    }
}

/// A text with as little as possible of this one that still fails: pieces are left out, in ever shorter runs, and at
/// last bytes, as long as it does.
pub fn smallest(bytes: &[u8], mut fails: impl FnMut(&[u8]) -> bool) -> Vec<u8> {
    let mut parts: Vec<Vec<u8>> = match std::str::from_utf8(bytes) {
        Ok(text) => pieces(text).into_iter().map(String::into_bytes).collect(),
        Err(_) => bytes.iter().map(|&byte| vec![byte]).collect(),
    };
    let mut length = parts.len() / 2;
    while length > 0 {
        let mut has_changed = false;
        let mut at = 0;
        while at < parts.len() {
            let end = (at + length).min(parts.len());
            let rest = [&parts[..at], &parts[end..]].concat();
            if fails(&rest.concat()) {
                parts = rest;
                has_changed = true;
            } else {
                at = end;
            }
        }
        if !has_changed || length > 1 {
            length /= 2;
        }
    }
    parts.concat()
}
