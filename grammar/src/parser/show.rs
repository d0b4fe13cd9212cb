//! `show`.

use crate::Span;
use crate::ast::{ExprId, Setting, Show};
use crate::cursor::Parser;
use crate::token::TokenKind;

impl Parser<'_> {
    /// `show = "show" NAME "(" subject { "," subject } ")" [ "{" [ setting { "," setting } [ "," ] ] "}" ]`
    pub(crate) fn show(&mut self) -> Show {
        self.bump();
        let mut scene = self.expect_scene();
        let mut args = Vec::new();
        if self.lacks_scene(&scene) {
            scene.text.clear();
            return Show {
                scene,
                args,
                settings: Vec::new(),
                span: Span::default(),
            };
        }
        if self.expect_subjects(&scene) {
            let opened = self.open();
            loop {
                if self.is_setting_inside() {
                    break;
                }
                args.push(self.subject());
                if !self.separator(&opened) {
                    break;
                }
            }
        }
        let mut settings = Vec::new();
        if self.at(TokenKind::LBrace) {
            let opened = self.open();
            loop {
                if self.at(TokenKind::RBrace) {
                    self.close(&opened);
                    break;
                }
                settings.extend(self.setting());
                if !self.missing_comma() && !self.separator(&opened) {
                    break;
                }
            }
        }
        Show {
            scene,
            args,
            settings,
            span: Span::default(),
        }
    }

    /// `subject = expr`, which may be the bare name of a function
    fn subject(&mut self) -> ExprId {
        self.bind_free_variables();
        self.takes_functions = true;
        let subject = self.expr();
        self.takes_functions = false;
        self.unbind_free_variables();
        subject.id
    }

    /// `setting = NAME "=" disjunction [ ".." disjunction ]`
    fn setting(&mut self) -> Option<Setting> {
        let Some(name) = self.expect_setting() else {
            self.skip_to_separator();
            return None;
        };
        self.takes_functions = true;
        let value = self.disjunction().id;
        let upper = self.eat(TokenKind::DotDot).then(|| self.disjunction().id);
        self.takes_functions = false;
        Some(Setting { name, value, upper })
    }
}
