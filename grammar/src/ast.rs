//! The syntax tree.
//!
//! Expressions live in one arena of the file, operands before their users, so a tree of any shape is dropped
//! and walked without recursion. Nesting other than left-leaning chains of binary operators is bounded by
//! [`MAX_NESTING`].

use crate::Span;

/// Greatest depth of nested brackets, conditionals, prefixes and right operands that the parser accepts.
pub const MAX_NESTING: usize = 200;
/// Greatest length of a source text in bytes.
pub const MAX_SOURCE_BYTES: usize = 4 << 20;

/// A parsed file.
#[derive(Clone, Debug, Default)]
pub struct File {
    /// Statements in the order of the text.
    pub items: Vec<Item>,
    /// Every expression of the file.
    pub exprs: Exprs,
}

/// Arena of expressions; operands precede their users.
#[derive(Clone, Debug, Default)]
pub struct Exprs {
    nodes: Vec<(Expr, Span)>,
}

/// Index of an expression in [`Exprs`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ExprId(u32);

impl ExprId {
    /// Position in the arena.
    #[must_use]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

impl Exprs {
    /// An empty arena with room for this many expressions.
    pub(crate) fn with_capacity(count: usize) -> Self {
        Self {
            nodes: Vec::with_capacity(count),
        }
    }

    /// Adds an expression.
    pub fn push(&mut self, expr: Expr, span: Span) -> ExprId {
        let id = ExprId(u32::try_from(self.nodes.len()).unwrap_or(u32::MAX));
        self.nodes.push((expr, span));
        id
    }

    /// Number of expressions.
    #[must_use]
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// Every expression with its id, operands before their users.
    pub fn iter(&self) -> impl Iterator<Item = (ExprId, &Expr, Span)> + '_ {
        (0..)
            .zip(&self.nodes)
            .map(|(index, (expr, span))| (ExprId(index), expr, *span))
    }

    /// The outermost expression at a place; found where expressions stand in the order of their ends, as the parser adds
    /// those of a text that is not pasted from elsewhere.
    #[must_use]
    pub fn at(&self, place: Span) -> Option<ExprId> {
        let first = self.nodes.partition_point(|(_, span)| span.end < place.end);
        let behind = self.nodes.get(first..)?.iter().enumerate();
        let ending = behind.take_while(|(_, (_, span))| span.end == place.end);
        let (offset, _) = ending.filter(|(_, (_, span))| *span == place).last()?;
        u32::try_from(first + offset).ok().map(ExprId)
    }

    /// The items of the one step of several states, `(z², 2 z d + w) where w = …`: a list with local names.
    #[must_use]
    pub fn joint_step(&self, steps: &[ExprId], states: usize) -> Option<&[ExprId]> {
        let (&[mut step], 2..) = (steps, states) else {
            return None;
        };
        while let Expr::Where { body, .. } = self[step] {
            step = body;
        }
        match &self[step] {
            Expr::Vector(items) if items.len() == states => Some(items),
            _ => None,
        }
    }

    /// Where the expression stands in the text.
    #[must_use]
    pub fn span(&self, id: ExprId) -> Span {
        self.nodes[id.0 as usize].1
    }
}

impl std::ops::Index<ExprId> for Exprs {
    type Output = Expr;
    fn index(&self, id: ExprId) -> &Expr {
        &self.nodes[id.0 as usize].0
    }
}

/// An identifier and its place. Greek letters keep their spelling in the text (`φ` is not `phi` here).
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Name {
    /// The spelling.
    pub text: String,
    /// The place.
    pub span: Span,
}

/// A statement.
#[derive(Clone, Debug)]
pub enum Item {
    /// `name(params) = body`
    Function(Function),
    /// `name = value`
    Constant(Constant),
    /// `param name = default in lo..hi`
    Param(Param),
    /// `show scene(args) { settings }`
    Show(Show),
    /// A bare expression: the formula itself, in its free variables.
    Formula(Formula),
}

impl Item {
    /// The whole statement.
    #[must_use]
    pub fn span(&self) -> Span {
        match self {
            Self::Function(item) => item.span,
            Self::Constant(item) => item.span,
            Self::Param(item) => item.span,
            Self::Show(item) => item.span,
            Self::Formula(item) => item.span,
        }
    }
}

/// `name(params) = body`
#[derive(Clone, Debug)]
pub struct Function {
    /// The function's name.
    pub name: Name,
    /// Formal parameters.
    pub params: Vec<Formal>,
    /// The body, often an [`Expr::Where`].
    pub body: ExprId,
    /// The whole statement.
    pub span: Span,
}

/// A formal parameter, `name` or `name: type`.
#[derive(Clone, Debug)]
pub struct Formal {
    /// The parameter's name.
    pub name: Name,
    /// Its annotation, such as `complex`; not yet checked to be a type.
    pub ty: Option<Name>,
}

/// `name = value`
#[derive(Clone, Debug)]
pub struct Constant {
    /// The constant's name.
    pub name: Name,
    /// Its value.
    pub value: ExprId,
    /// The whole statement.
    pub span: Span,
}

/// `param name = default in lo..hi`; the range is optional.
#[derive(Clone, Debug)]
pub struct Param {
    /// The parameter's name.
    pub name: Name,
    /// Value at the start.
    pub default: ExprId,
    /// Ends of the slider.
    pub range: Option<(ExprId, ExprId)>,
    /// The whole statement.
    pub span: Span,
}

/// `show scene(args) { settings }`; the settings are optional.
#[derive(Clone, Debug)]
pub struct Show {
    /// Name of the scene.
    pub scene: Name,
    /// What is shown: names of functions, or formulas in free variables.
    pub args: Vec<ExprId>,
    /// Settings in the order of the text.
    pub settings: Vec<Setting>,
    /// The whole statement.
    pub span: Span,
}

/// `name = value` or `name = lo..hi` in the braces of a `show`.
#[derive(Clone, Debug)]
pub struct Setting {
    /// The setting's name.
    pub name: Name,
    /// Its value; for a range, the lower end.
    pub value: ExprId,
    /// The upper end of a range.
    pub upper: Option<ExprId>,
}

/// A bare expression as a statement.
#[derive(Clone, Debug)]
pub struct Formula {
    /// The expression.
    pub body: ExprId,
    /// The whole statement.
    pub span: Span,
}

/// An expression.
#[derive(Clone, Debug, PartialEq)]
pub enum Expr {
    /// Stands where the text could not be read; a diagnostic has been given.
    Error,
    /// `2.5`, `1e-3`, `.5`
    Number(f64),
    /// `2i`
    Imaginary(f64),
    /// `x`, `pi`, `φ`
    Name(Name),
    /// `-x`, `not a`, `√x`, `n!`, `|x|`
    Unary {
        /// Which operator.
        op: UnaryOp,
        /// Its operand.
        arg: ExprId,
    },
    /// `a + b`, `a b`, `a^b`, `a and b`
    Binary {
        /// Which operator.
        op: BinaryOp,
        /// Left operand.
        lhs: ExprId,
        /// Right operand.
        rhs: ExprId,
    },
    /// `a < b ≤ c`: the conjunction of its steps.
    Compare {
        /// Leftmost operand.
        first: ExprId,
        /// Each comparison with its right operand; never empty.
        rest: Vec<(CompareOp, ExprId)>,
    },
    /// `f(x, y)`, `f'(z)`
    Call {
        /// The function's name.
        callee: Name,
        /// Number of primes after the name.
        primes: u32,
        /// Arguments.
        args: Vec<ExprId>,
    },
    /// `p.xy`
    Member {
        /// The vector.
        base: ExprId,
        /// The swizzle.
        field: Name,
    },
    /// `(a, b)`: a vector of two to four components.
    Vector(Vec<ExprId>),
    /// `if c then a else b`
    If {
        /// The condition.
        cond: ExprId,
        /// Value where it holds.
        then: ExprId,
        /// Value where it does not.
        otherwise: ExprId,
    },
    /// `{ x < 0: -x, x < 1: x^2, else: 1 }`: the first arm whose condition holds; NaN without `else` where none does.
    Piecewise {
        /// Conditions and values.
        arms: Vec<(ExprId, ExprId)>,
        /// Value where no condition holds.
        otherwise: Option<ExprId>,
    },
    /// `body where a = …, p.xy = …`: each local sees those before it.
    Where {
        /// The value.
        body: ExprId,
        /// Local names in order.
        locals: Vec<Local>,
    },
    /// `sum(k in 1..n, term)`, `product(j in 1..m, k in 1..j, term)`
    Series {
        /// What is done with the terms.
        kind: SeriesKind,
        /// The running variables, outermost first; never empty. Each sees those before it.
        ranges: Vec<Range>,
        /// The term, which sees every running variable.
        term: ExprId,
    },
    /// `iterate(n, z = z0, w = 1, (z^2 + c, 2 z w) until |z| > 2)`
    Iterate {
        /// Greatest number of steps.
        count: ExprId,
        /// Names of the states with their values at the start; never empty. A start does not see the states.
        states: Vec<(Name, ExprId)>,
        /// The next value of each state in order, each in the values before the step. As many as there are states, or
        /// one that has as many items: see [`Exprs::joint_step`].
        steps: Vec<ExprId>,
        /// Tested before each step; where it holds, the iteration ends.
        until: Option<ExprId>,
    },
    /// `integral(body, t, a, b)`, `integral(t in a..b, body)`, and `quadrature` alike
    Integral {
        /// How it is found.
        method: Method,
        /// The integrand, which sees the variable.
        body: ExprId,
        /// The variable and the ends.
        range: Range,
    },
}

/// `name in lower..upper` of a series or an integral.
#[derive(Clone, Debug, PartialEq)]
pub struct Range {
    /// The running variable.
    pub name: Name,
    /// Its first value.
    pub lower: ExprId,
    /// Its last value.
    pub upper: ExprId,
}

/// A local name of a `where`.
#[derive(Clone, Debug, PartialEq)]
pub struct Local {
    /// The name.
    pub name: Name,
    /// The components that are replaced, as in `p.xy = …`; the others stay those of the `p` seen so far.
    pub field: Option<Name>,
    /// The value.
    pub value: ExprId,
}

/// How an integral is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Method {
    /// In closed form.
    Closed,
    /// Numerically.
    Quadrature,
}

impl Method {
    /// The word that asks for it.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Closed => "integral",
            Self::Quadrature => "quadrature",
        }
    }
}

/// What a series does with its terms.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SeriesKind {
    /// `sum(…)`; 0 without terms
    Sum,
    /// `product(…)`; 1 without terms
    Product,
}

impl Expr {
    /// Calls `visit` for each operand, in the order of the text.
    pub fn for_each_child(&self, mut visit: impl FnMut(ExprId)) {
        match self {
            Self::Error | Self::Number(_) | Self::Imaginary(_) | Self::Name(_) => {}
            Self::Unary { arg, .. } => visit(*arg),
            Self::Binary { lhs, rhs, .. } => {
                visit(*lhs);
                visit(*rhs);
            }
            Self::Compare { first, rest } => {
                visit(*first);
                rest.iter().for_each(|step| visit(step.1));
            }
            Self::Call { args, .. } | Self::Vector(args) => args.iter().copied().for_each(visit),
            Self::Member { base, .. } => visit(*base),
            Self::If {
                cond,
                then,
                otherwise,
            } => {
                visit(*cond);
                visit(*then);
                visit(*otherwise);
            }
            Self::Piecewise { arms, otherwise } => {
                for &(cond, value) in arms {
                    visit(cond);
                    visit(value);
                }
                otherwise.iter().copied().for_each(visit);
            }
            Self::Where { body, locals } => {
                visit(*body);
                locals.iter().for_each(|local| visit(local.value));
            }
            Self::Series { ranges, term, .. } => {
                for range in ranges {
                    visit(range.lower);
                    visit(range.upper);
                }
                visit(*term);
            }
            Self::Iterate {
                count,
                states,
                steps,
                until,
            } => {
                visit(*count);
                states.iter().for_each(|state| visit(state.1));
                steps.iter().copied().for_each(&mut visit);
                until.iter().copied().for_each(visit);
            }
            Self::Integral { body, range, .. } => {
                visit(*body);
                visit(range.lower);
                visit(range.upper);
            }
        }
    }
}

/// Operators of one operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum UnaryOp {
    /// `-x`
    Neg,
    /// `not a`
    Not,
    /// `√x`
    Sqrt,
    /// `n!`
    Factorial,
    /// `|x|`: absolute value, modulus, or length.
    Abs,
}

/// Operators of two operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BinaryOp {
    /// `a + b`
    Add,
    /// `a - b`
    Sub,
    /// `a * b`, `a · b`, `a × b`
    Mul,
    /// `a b`: a product without a sign.
    ImplicitMul,
    /// `a / b`
    Div,
    /// `a ^ b`, `a²`
    Pow,
    /// `a and b`
    And,
    /// `a or b`
    Or,
}

/// Comparisons.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CompareOp {
    /// `<`
    Less,
    /// `<=`, `≤`
    LessEqual,
    /// `>`
    Greater,
    /// `>=`, `≥`
    GreaterEqual,
    /// `==`
    Equal,
    /// `!=`, `≠`
    NotEqual,
}
