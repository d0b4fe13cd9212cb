//! Names of other notations where the parser meets them: read as ours where they mean nothing in the program.

use super::names::{function_of, type_of, value_of};
use crate::Diagnostic;
use crate::ast::Name;
use crate::cursor::{Node, Parser};
use crate::scope::Role;
use crate::token::TokenKind;

impl Parser<'_> {
    /// What a name stands for; a name that is only known elsewhere becomes ours.
    pub(crate) fn role_of(&mut self, name: &mut Name) -> Role {
        let role = self.role_of_ours(name);
        if role != Role::Unknown {
            return role;
        }
        if self.is_applied()
            && let Some(ours) = function_of(&name.text)
            && self.scope.is_builtin(ours)
            && self.scope.is_free(ours)
        {
            self.rename(name, ours);
            return Role::Function;
        }
        if let Some(ours) = value_of(&name.text)
            && self.scope.is_free(ours)
        {
            self.rename(name, ours);
            return Role::Value;
        }
        role
    }

    /// Gives a name our spelling.
    fn rename(&mut self, name: &mut Name, ours: &str) {
        ours.clone_into(&mut name.text);
        self.foreign.push(name.span);
    }

    /// What is in the brackets here, without the name of a type before them: `float(x)`.
    pub(crate) fn conversion(&mut self, name: &Name) -> Node {
        self.foreign.push(name.span);
        self.primary()
    }

    /// Whether arguments follow, perhaps behind a power.
    fn is_applied(&self) -> bool {
        match self.kind() {
            TokenKind::LParen => true,
            TokenKind::Superscript => self.ahead(1) == TokenKind::LParen,
            TokenKind::Caret => {
                self.ahead(1) == TokenKind::Number && self.ahead(2) == TokenKind::LParen
            }
            _ => false,
        }
    }

    /// The function of this name and number of arguments: `atan(y, x)` is `atan2`.
    pub(crate) fn by_arguments(&mut self, mut callee: Name, count: usize) -> Name {
        let is_angle = count == 2
            && matches!(callee.text.as_str(), "atan" | "arctan")
            && !self.scope.defines_function(&callee.text)
            && self.scope.is_builtin("atan2")
            && self.scope.is_free("atan2");
        if is_angle {
            if callee.span.text(self.text) == "ArcTan" {
                self.diagnostics.push(
                    Diagnostic::error(
                        "other-meaning",
                        callee.span,
                        "the arguments of `ArcTan` are x and y",
                    )
                    .with_label("`atan2` takes y first")
                    .with_hint("y comes first: `atan2(y, x)`"),
                );
            }
            self.rename(&mut callee, "atan2");
        }
        callee
    }

    /// The name of a type, which becomes ours.
    pub(crate) fn bump_type(&mut self) -> Name {
        let mut name = self.bump_name();
        if let Some(ours) = type_of(&name.text) {
            self.rename(&mut name, ours);
        }
        name
    }
}
