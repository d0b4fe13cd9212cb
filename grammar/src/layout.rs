//! Tokens to statements: where each begins and ends, what kind it is, and which names it defines.
//!
//! Done before parsing, so that a damaged statement cannot spill into the next, and so that `name(` can be told
//! from a product of a name and a bracket.

use crate::token::{Token, TokenKind};

/// What a statement is, as its first tokens say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum StatementKind {
    /// `name(params) = body`
    Function,
    /// `name = value`
    Constant,
    /// `param …`
    Param,
    /// `show …`
    Show,
    /// Anything else.
    Formula,
}

/// A run of tokens that is one statement.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Statement {
    /// Index of the first token.
    pub(crate) start: usize,
    /// One past the index of the last token.
    pub(crate) end: usize,
    /// What it is.
    pub(crate) kind: StatementKind,
    /// Index of the token that begins the definition: past a word such as `let` that does not belong there.
    pub(crate) head: usize,
}

/// The statements of a file and the locals of its expressions.
#[derive(Debug, Default)]
pub(crate) struct Layout {
    /// In the order of the text.
    pub(crate) statements: Vec<Statement>,
    /// For each local of a `where`, the index of the first token of the expression in which it holds and that of
    /// its name; sorted.
    locals: Vec<(usize, usize)>,
    /// For each bracket whose second item is a bare name, the index of the first token inside and that of the name;
    /// sorted.
    variables: Vec<(usize, usize)>,
}

impl Layout {
    /// The name tokens from `from` on of the locals that hold in the expression that begins at token `start`.
    pub(crate) fn locals(&self, start: usize, from: usize) -> impl Iterator<Item = usize> + '_ {
        let first = self.locals.partition_point(|local| *local < (start, from));
        let rest = self.locals.get(first..).unwrap_or_default();
        rest.iter()
            .take_while(move |local| local.0 == start)
            .map(|local| local.1)
    }

    /// The name token of `t` in `(expr, t, …)`, where the bracket's first token is `start`.
    pub(crate) fn variable(&self, start: usize) -> Option<usize> {
        let found = self.variables.binary_search_by_key(&start, |entry| entry.0);
        found
            .ok()
            .and_then(|index| self.variables.get(index))
            .map(|entry| entry.1)
    }
}

/// A bracket that is open, or the statement itself.
struct Level {
    open: TokenKind,
    start: usize,
    expression: usize,
    has_where: bool,
}

/// What a token tells of names that hold somewhere.
enum Holds {
    /// The beginning of an expression and the name of its local.
    Local(usize, usize),
    /// The beginning of a bracket's inside and the name that is its second item.
    Variable(usize, usize),
}

/// The brackets open at a place.
struct Levels {
    stack: Vec<Level>,
    parens: usize,
    braces: usize,
}

/// Splits the tokens of a file into statements.
pub(crate) fn layout(tokens: &[Token]) -> Layout {
    let mut layout = Layout::default();
    let mut levels = Levels::new(0);
    let mut start = 0;
    for (at, token) in tokens.iter().enumerate() {
        if token.kind == TokenKind::Semicolon {
            if levels.is_outside() || definition_begins(tokens, at + 1) {
                layout.close(tokens, start, at);
                start = at + 1;
                levels = Levels::new(start);
            }
            continue;
        }
        if at > start && token.starts_line && begins_statement(tokens, start, at, &levels) {
            layout.close(tokens, start, at);
            start = at;
            levels = Levels::new(start);
        }
        match levels.read(tokens, at) {
            Some(Holds::Local(expression, name)) => layout.locals.push((expression, name)),
            Some(Holds::Variable(inside, name)) => layout.variables.push((inside, name)),
            None => {}
        }
    }
    layout.close(tokens, start, tokens.len());
    layout.locals.sort_unstable();
    layout.variables.sort_unstable();
    layout
}

impl Layout {
    /// Adds the statement of the tokens `start..end` unless there are none.
    fn close(&mut self, tokens: &[Token], start: usize, end: usize) {
        if start < end {
            let (kind, head) = classify(tokens.get(..end).unwrap_or(tokens), start);
            self.statements.push(Statement {
                start,
                end,
                kind,
                head,
            });
        }
    }
}

impl Levels {
    /// No bracket is open; the statement begins at token `start`.
    fn new(start: usize) -> Self {
        Self {
            stack: vec![Level {
                open: TokenKind::End,
                start,
                expression: start,
                has_where: false,
            }],
            parens: 0,
            braces: 0,
        }
    }

    /// Whether no bracket is open.
    fn is_outside(&self) -> bool {
        self.stack.len() <= 1
    }

    /// Takes in the token at `at`.
    fn read(&mut self, tokens: &[Token], at: usize) -> Option<Holds> {
        let kind = kind(tokens, at);
        let is_field = at > 0 && self::kind(tokens, at - 1) == TokenKind::Dot;
        let names_local = defines_name(tokens, at) && !is_field;
        let outside = self.is_outside();
        match kind {
            TokenKind::LParen | TokenKind::LBrace => self.open(kind, at),
            TokenKind::RParen => self.close(TokenKind::LParen),
            TokenKind::RBrace => self.close(TokenKind::LBrace),
            _ => {
                let level = self.stack.last_mut()?;
                match kind {
                    TokenKind::Where => level.has_where = true,
                    TokenKind::Name if names_local && level.has_where => {
                        return Some(Holds::Local(level.expression, at));
                    }
                    TokenKind::Comma if !(level.has_where && local_begins(tokens, at + 1)) => {
                        let is_first = level.expression == level.start && !outside;
                        level.expression = at + 1;
                        level.has_where = false;
                        if is_first && is_bare_name(tokens, at + 1) {
                            return Some(Holds::Variable(level.start, at + 1));
                        }
                    }
                    TokenKind::Colon | TokenKind::Until => {
                        level.expression = at + 1;
                        level.has_where = false;
                    }
                    TokenKind::Equals if outside && !level.has_where => level.expression = at + 1,
                    _ => {}
                }
            }
        }
        None
    }

    fn open(&mut self, open: TokenKind, at: usize) {
        if open == TokenKind::LParen {
            self.parens += 1;
        } else {
            self.braces += 1;
        }
        self.stack.push(Level {
            open,
            start: at + 1,
            expression: at + 1,
            has_where: false,
        });
    }

    /// Closes the innermost bracket of this kind and what is open inside it; nothing where none is open.
    fn close(&mut self, open: TokenKind) {
        let count = if open == TokenKind::LParen {
            self.parens
        } else {
            self.braces
        };
        if count == 0 {
            return;
        }
        while let Some(level) = self.stack.pop() {
            if level.open == TokenKind::LParen {
                self.parens -= 1;
            } else {
                self.braces -= 1;
            }
            if level.open == open {
                break;
            }
        }
    }
}

/// The kind of the token at `at`, [`TokenKind::End`] past the last.
fn kind(tokens: &[Token], at: usize) -> TokenKind {
    tokens.get(at).map_or(TokenKind::End, |token| token.kind)
}

/// Whether `name =` stands at `at`, or `name.field =`.
fn local_begins(tokens: &[Token], at: usize) -> bool {
    defines_name(tokens, at)
        || kind(tokens, at) == TokenKind::Name
            && kind(tokens, at + 1) == TokenKind::Dot
            && defines_name(tokens, at + 2)
}

/// Whether `name =` stands at `at`.
fn defines_name(tokens: &[Token], at: usize) -> bool {
    kind(tokens, at) == TokenKind::Name && kind(tokens, at + 1) == TokenKind::Equals
}

/// Whether a name that is a whole item stands at `at`.
fn is_bare_name(tokens: &[Token], at: usize) -> bool {
    kind(tokens, at) == TokenKind::Name
        && matches!(kind(tokens, at + 1), TokenKind::Comma | TokenKind::RParen)
}

/// Whether the token at `at`, the first of its line, begins a statement.
fn begins_statement(tokens: &[Token], start: usize, at: usize, levels: &Levels) -> bool {
    let before = kind(tokens, at - 1);
    if levels.is_outside() && !wants_more(before) && !goes_on(kind(tokens, at)) {
        return true;
    }
    if defines_name(tokens, at) {
        let in_settings = levels.braces > 0 && kind(tokens, start) == TokenKind::Show;
        return !in_settings && !matches!(before, TokenKind::Where | TokenKind::Comma);
    }
    before != TokenKind::Where && definition_begins(tokens, at)
}

/// Whether a line that ends in this token goes on in the next.
pub(crate) fn wants_more(kind: TokenKind) -> bool {
    use TokenKind::{Comma, DotDot, Else, Equals, If, In, Not, Root, Then, Until, Where};
    kind.is_infix()
        || matches!(
            kind,
            Comma | Equals | Where | Then | Else | If | In | DotDot | Not | Root | Until
        )
}

/// Whether a line that begins with this token belongs to the line before.
pub(crate) fn goes_on(kind: TokenKind) -> bool {
    use TokenKind::{Comma, DotDot, Else, Equals, In, Then, Until, Where};
    kind.is_infix()
        || matches!(
            kind,
            Comma | Equals | Where | Then | Else | In | DotDot | Until
        )
}

/// Whether something that can only be a statement stands at `at`.
pub(crate) fn definition_begins(tokens: &[Token], at: usize) -> bool {
    match kind(tokens, at) {
        TokenKind::Param | TokenKind::Show => true,
        TokenKind::Name => match kind(tokens, at + 1) {
            TokenKind::Equals => true,
            TokenKind::LParen => {
                // Only the plain form, so that this look-ahead stays short.
                let mut end = at + 2;
                while matches!(
                    kind(tokens, end),
                    TokenKind::Name | TokenKind::Comma | TokenKind::Colon
                ) {
                    end += 1;
                }
                kind(tokens, end) == TokenKind::RParen && kind(tokens, end + 1) == TokenKind::Equals
            }
            _ => false,
        },
        _ => false,
    }
}

/// What the statement that begins at `start` is, and where its definition begins; `tokens` end with it.
fn classify(tokens: &[Token], start: usize) -> (StatementKind, usize) {
    let first = kind(tokens, start);
    match first {
        TokenKind::Param => return (StatementKind::Param, start),
        TokenKind::Show => return (StatementKind::Show, start),
        _ => {}
    }
    if first == TokenKind::Name || first.is_keyword() {
        if let Some(found) = definition(tokens, start) {
            return (found, start);
        }
        if first == TokenKind::Name
            && kind(tokens, start + 1) == TokenKind::Name
            && let Some(found) = definition(tokens, start + 1)
        {
            return (found, start + 1);
        }
    }
    (StatementKind::Formula, start)
}

/// What the name at `at` begins to define.
fn definition(tokens: &[Token], at: usize) -> Option<StatementKind> {
    let mut next = at + 1;
    while kind(tokens, next) == TokenKind::Prime {
        next += 1;
    }
    if equals_at(tokens, next) {
        return Some(StatementKind::Constant);
    }
    let is_word = kind(tokens, at) == TokenKind::Name;
    if !is_word || kind(tokens, next) != TokenKind::LParen {
        return None;
    }
    let mut depth = 0_usize;
    for (offset, token) in tokens.get(next..)?.iter().enumerate() {
        match token.kind {
            TokenKind::LParen => depth += 1,
            TokenKind::RParen => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return equals_at(tokens, next + offset + 1).then_some(StatementKind::Function);
        }
    }
    None
}

/// Whether the `=` at `at` belongs to `=<` or `=>`.
fn is_reversed_comparison(tokens: &[Token], at: usize) -> bool {
    let (Some(equals), Some(next)) = (tokens.get(at), tokens.get(at + 1)) else {
        return false;
    };
    matches!(next.kind, TokenKind::Less | TokenKind::Greater) && next.span.start == equals.span.end
}

/// Whether the `=` of a definition stands at `at`.
fn equals_at(tokens: &[Token], at: usize) -> bool {
    kind(tokens, at) == TokenKind::Equals && !is_reversed_comparison(tokens, at)
}
