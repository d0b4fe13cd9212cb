//! The commands of LaTeX that have a meaning here.

use crate::token::TokenKind;

/// What a command means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Meaning {
    /// Spacing and style.
    Nothing,
    /// A name of a value.
    Name(&'static str),
    /// A function, whose argument may stand without brackets.
    Function(&'static str),
    /// Another spelling of a token.
    Token(TokenKind),
    /// `\frac{a}{b}`
    Fraction,
    /// `\sqrt[n]{x}`
    Root,
    /// `\bar{z}`: a function of one group
    Accent(&'static str),
    /// `\mathrm{x}`: the name in the group
    Font,
    /// `\operatorname{f}`: the function in the group
    Operator,
    /// `\left`, `\big`: before a delimiter
    Sizing,
    /// `\lfloor`: opens a function of what is inside
    Opening(&'static str, &'static str),
    /// `\lvert`, closed by another command
    OpeningBar(&'static str),
    /// Closes what another command opens.
    Closing,
    /// `\{`
    Brace,
    /// `\sum`, `\prod`
    Series(&'static str),
    /// `\int`
    Integral,
    /// `\begin{cases}`
    Begin,
    /// `\end`
    End,
    /// `\\`
    Row,
    /// What has no meaning here, and what to write.
    Refused(&'static str),
}

/// What a command means; nothing where we do not know it.
pub(super) fn meaning(command: &str) -> Option<Meaning> {
    use Meaning::{
        Accent, Begin, Brace, Closing, End, Font, Fraction, Integral, Name, Nothing, Opening,
        OpeningBar, Operator, Root, Row, Series, Sizing, Token,
    };
    let name = command.strip_prefix('\\')?;
    if let Some(letter) = greek(name) {
        return Some(Name(letter));
    }
    if let Some(function) = function(name) {
        return Some(Meaning::Function(function));
    }
    Some(match name {
        "," | ";" | ":" | "!" | ">" | "/" | " " | "\n" | "\r\n" | "\t" | "quad" | "qquad"
        | "thinspace" | "displaystyle" | "textstyle" | "limits" | "nolimits" | "rm" | "it"
        | "bf" | "(" | ")" | "[" | "]" => Nothing,
        "left" | "right" | "middle" | "big" | "Big" | "bigg" | "Bigg" | "bigl" | "Bigl"
        | "biggl" | "Biggl" | "bigr" | "Bigr" | "biggr" | "Biggr" | "bigm" | "Bigm" => Sizing,
        "infty" => Name("∞"),
        "imath" => Name("i"),
        "cdot" | "times" | "ast" => Token(TokenKind::Star),
        "div" => Token(TokenKind::Slash),
        "le" | "leq" | "leqslant" => Token(TokenKind::LessEqual),
        "ge" | "geq" | "geqslant" => Token(TokenKind::GreaterEqual),
        "lt" => Token(TokenKind::Less),
        "gt" => Token(TokenKind::Greater),
        "ne" | "neq" => Token(TokenKind::NotEqual),
        "land" | "wedge" => Token(TokenKind::And),
        "lor" | "vee" => Token(TokenKind::Or),
        "lnot" | "neg" => Token(TokenKind::Not),
        "vert" | "Vert" | "mid" | "|" => Token(TokenKind::Bar),
        "colon" => Token(TokenKind::Colon),
        "prime" => Token(TokenKind::Prime),
        "frac" | "dfrac" | "tfrac" | "cfrac" => Fraction,
        "sqrt" => Root,
        "bar" | "overline" => Accent("conj"),
        "mathrm" | "mathit" | "mathbf" | "mathsf" | "text" | "textrm" | "textit" | "mbox"
        | "boldsymbol" | "vec" => Font,
        "operatorname" => Operator,
        "lfloor" => Opening("floor", "\\rfloor"),
        "lceil" => Opening("ceil", "\\rceil"),
        "lvert" => OpeningBar("\\rvert"),
        "lVert" => OpeningBar("\\rVert"),
        "rfloor" | "rceil" | "rvert" | "rVert" => Closing,
        "{" | "}" | "lbrace" | "rbrace" => Brace,
        "sum" => Series("sum"),
        "prod" => Series("product"),
        "int" => Integral,
        "begin" => Begin,
        "end" => End,
        "\\" => Row,
        _ => return refused(name).map(Meaning::Refused),
    })
}

/// Functions, by their names in LaTeX and by those that packages and people give them.
pub(super) fn function(name: &str) -> Option<&'static str> {
    Some(match name {
        "sin" => "sin",
        "cos" => "cos",
        "tan" | "tg" => "tan",
        "cot" | "ctg" | "cotg" => "cot",
        "sec" => "sec",
        "csc" | "cosec" => "csc",
        "arcsin" | "asin" => "asin",
        "arccos" | "acos" => "acos",
        "arctan" | "arctg" | "atan" => "atan",
        "sinh" | "sh" => "sinh",
        "cosh" | "ch" => "cosh",
        "tanh" | "th" => "tanh",
        "coth" | "cth" => "coth",
        "sech" => "sech",
        "csch" => "csch",
        "arsinh" | "arcsinh" | "asinh" => "asinh",
        "arcosh" | "arccosh" | "acosh" => "acosh",
        "artanh" | "arctanh" | "atanh" => "atanh",
        "exp" => "exp",
        "ln" | "log" | "Log" | "Ln" => "log",
        "lg" => "log10",
        "lb" => "log2",
        "sgn" | "sign" => "sign",
        "Re" => "re",
        "Im" => "im",
        "arg" | "Arg" => "arg",
        "min" => "min",
        "max" => "max",
        _ => return None,
    })
}

/// Letters; variants are the letters that they are variants of, where Unicode has no letter for them.
fn greek(name: &str) -> Option<&'static str> {
    Some(match name {
        "alpha" => "α",
        "beta" => "β",
        "gamma" => "γ",
        "delta" => "δ",
        "epsilon" => "ϵ",
        "varepsilon" => "ε",
        "zeta" => "ζ",
        "eta" => "η",
        "theta" => "θ",
        "vartheta" => "ϑ",
        "iota" => "ι",
        "kappa" => "κ",
        "lambda" => "λ",
        "mu" => "μ",
        "nu" => "ν",
        "xi" => "ξ",
        "pi" => "π",
        "rho" => "ρ",
        "varrho" => "ϱ",
        "sigma" => "σ",
        "tau" => "τ",
        "upsilon" => "υ",
        "phi" | "varphi" => "φ",
        "chi" => "χ",
        "psi" => "ψ",
        "omega" => "ω",
        "Gamma" => "Γ",
        "Delta" => "Δ",
        "Theta" => "Θ",
        "Lambda" => "Λ",
        "Xi" => "Ξ",
        "Pi" => "Π",
        "Sigma" => "Σ",
        "Upsilon" => "Υ",
        "Phi" => "Φ",
        "Psi" => "Ψ",
        "Omega" => "Ω",
        _ => return None,
    })
}

/// What to write instead of what has no meaning here.
fn refused(name: &str) -> Option<&'static str> {
    Some(match name {
        "pm" | "mp" => "write the two formulas, one with `+` and one with `-`",
        "circ" => "write `f(g(x))` for functions one after the other, `x π/180` for degrees",
        "partial" => "write `diff(expr, x)`",
        "nabla" => "write `grad(f)`",
        "lim" => "there are no limits; write the value itself",
        "iint" | "iiint" | "oint" => "write one `integral(expr, t, a, b)` inside of another",
        "ldots" | "dots" | "cdots" => "write `sum(k in 1..n, term)` or `product(k in 1..n, term)`",
        "to" | "rightarrow" | "mapsto" | "Rightarrow" => "write `name(x) = …` to define a function",
        "in" => "write comparisons, as in `0 <= x <= 1`",
        "langle" | "rangle" => "write `(a, b)` for a vector, `dot(a, b)` for the inner product",
        "approx" | "simeq" | "sim" => "write `|a - b| < 1e-3`, or how near you want it",
        "equiv" => "write `==` to compare",
        "binom" => "write `n!/(k! (n - k)!)`",
        "bmod" | "mod" | "pmod" => "write `mod(a, b)` for a remainder",
        "hat" | "tilde" | "dot" | "ddot" => "choose a name of letters, digits and `_`",
        "det" => "there are no matrices; write the determinant out",
        "def" | "newcommand" => "write `name(x) = …`",
        _ => return None,
    })
}
