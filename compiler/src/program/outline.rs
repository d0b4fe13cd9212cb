//! What a program defines, as editors show it.

use super::ParamInfo;
use super::checker::Checker;
use super::subject::declared;
use crate::check::Builder;
use crate::types::Type;
use pullback_grammar::Span;
use pullback_grammar::ast::Item;

/// Most signatures that are listed of one function.
pub const MAX_SIGNATURES: usize = 16;

/// The definitions of a program in the order of the text, those of a program with errors included.
#[derive(Clone, Debug, Default)]
pub struct Outline {
    /// Functions.
    pub functions: Vec<FunctionInfo>,
    /// Constants.
    pub constants: Vec<ConstantInfo>,
    /// Parameters, each with the place of its name.
    pub params: Vec<(Span, ParamInfo)>,
}

/// A function of a program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FunctionInfo {
    /// Its name.
    pub name: String,
    /// Where it is named in its definition.
    pub span: Span,
    /// Names of its parameters, with their types where those are declared.
    pub params: Vec<(String, Option<Type>)>,
    /// The types with which it is used, or for a function that nothing uses, types with which it can be: at most
    /// [`MAX_SIGNATURES`]. None where it has errors.
    pub signatures: Vec<Signature>,
}

/// Types of the arguments of a function, and of its value for them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Signature {
    /// Types of the arguments in order.
    pub inputs: Vec<Type>,
    /// Type of the value.
    pub result: Type,
}

/// A constant of a program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ConstantInfo {
    /// Its name.
    pub name: String,
    /// Where it is named in its definition.
    pub span: Span,
    /// Its type; none where it has errors, or nothing uses it.
    pub ty: Option<Type>,
}

impl Checker<'_> {
    /// The definitions, after everything has been checked.
    pub(super) fn outline(&self, params: &[ParamInfo]) -> Outline {
        let mut outline = Outline::default();
        let mut params = params.iter();
        for item in &self.file.items {
            match item {
                Item::Function(function) => {
                    let name = function.name.text.as_str();
                    let declared = declared(function);
                    let mut signatures = self.signatures.get(name).cloned().unwrap_or_default();
                    signatures.sort_by_cached_key(|signature| {
                        let inputs = signature.inputs.iter().map(Type::to_string);
                        inputs.collect::<Vec<_>>().join(" ")
                    });
                    let named = |(name, ty): &(&str, Option<Type>)| ((*name).to_owned(), *ty);
                    outline.functions.push(FunctionInfo {
                        name: name.to_owned(),
                        span: function.name.span,
                        params: declared.iter().map(named).collect(),
                        signatures,
                    });
                }
                Item::Constant(constant) => outline.constants.push(ConstantInfo {
                    name: constant.name.text.clone(),
                    span: constant.name.span,
                    ty: self.constants.get(constant.name.text.as_str()).copied(),
                }),
                Item::Param(param) => {
                    let info = params.next().cloned();
                    outline
                        .params
                        .extend(info.map(|info| (param.name.span, info)));
                }
                Item::Show(_) | Item::Formula(_) => {}
            }
        }
        outline
    }
}

impl<'a> Checker<'a> {
    /// Remembers the types with which a builder has used functions and constants.
    pub(super) fn remember_types(&mut self, builder: &Builder<'a>) {
        for (name, inputs, result) in builder.signatures() {
            let signature = Signature { inputs, result };
            let known = self.signatures.entry(name).or_default();
            if known.len() < MAX_SIGNATURES && !known.contains(&signature) {
                known.push(signature);
            }
        }
        self.constants.extend(builder.constant_types());
    }
}
