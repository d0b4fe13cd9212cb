//! Functions and their calls.

use naga::{Expression, Function, Handle, TypeInner};
use pullback_compiler::lower::Format;
use pullback_compiler::table::Meaning;

use super::body::{Body, Known, Returns};
use super::memory::Maker;
use super::{Frame, Parts, Translator};
use crate::executor::code::{Form, Inst, Op};
use crate::executor::fault::Fault;
use crate::executor::library::{LibraryCall, Operand, Stand, stand};
use crate::executor::trace::SiteKind;

/// A function that is translated by itself.
#[derive(Debug)]
pub(super) struct Compiled {
    entry: u32,
    arguments: Vec<Parts>,
    results: Parts,
}

impl<'m> Translator<'m> {
    /// Registers for an argument.
    pub(super) fn argument_registers(&mut self, inner: &TypeInner) -> Result<Parts, Fault> {
        let count = self.shapes.inner_size(inner)?;
        (0..count).map(|_| self.frame.take()).collect()
    }

    /// Translates a function by itself.
    pub(super) fn stand_alone(
        &mut self,
        handle: Handle<Function>,
        function: &'m Function,
    ) -> Result<(), Fault> {
        let floor = self.plans.floor(function);
        self.frame = Frame::new(floor);
        let before = self.owned_by(function);
        let mut body = Body::new(
            function,
            &self.info[handle],
            Some(handle),
            self.options.contraction,
        )?;
        for argument in &function.arguments {
            let parts = self.argument_registers(&self.module.types[argument.ty].inner)?;
            body.arguments.push(parts);
        }
        let arguments = body.arguments.clone();
        let entry = self.here();
        let results = self.function_body(&mut body)?;
        self.emit(Inst::new(Op::End));
        self.owner = before;
        self.plans.set_floor(handle, self.frame.top());
        let compiled = Compiled {
            entry,
            arguments,
            results,
        };
        self.compiled.insert(handle, compiled);
        Ok(())
    }

    /// Translates a body that ends at its own end; gives where its result is.
    pub(super) fn function_body(&mut self, body: &mut Body<'m>) -> Result<Parts, Fault> {
        body.returns = self.returns(body, false)?;
        self.pending.push(Vec::new());
        self.open_block();
        self.begin(body)?;
        self.statements(body, &body.function.body)?;
        self.trace_results(body)?;
        self.close_block();
        self.join_here();
        Ok(body.results.clone())
    }

    /// How a body returns: its last statement gives the result, or lanes leave it one after another.
    fn returns(&mut self, body: &mut Body<'m>, written_out: bool) -> Result<Returns, Fault> {
        if body.returns_at_end() {
            return Ok(Returns::AtEnd);
        }
        if let Some(result) = &body.function.result {
            body.results = self.argument_registers(&self.module.types[result.ty].inner)?;
        }
        if !written_out {
            return Ok(Returns::Quit);
        }
        let gone = self.frame.take()?;
        self.emit(Inst::new(Op::Clear).to(gone).of(gone));
        Ok(Returns::Leave(gone))
    }

    /// A call statement.
    pub(super) fn call(
        &mut self,
        body: &mut Body<'m>,
        callee: Handle<Function>,
        arguments: &[Handle<Expression>],
        result: Option<Handle<Expression>>,
    ) -> Result<(), Fault> {
        let mut given = Vec::with_capacity(arguments.len());
        for &argument in arguments {
            given.push(self.value(body, argument)?);
        }
        let function = &self.module.functions[callee];
        let mark = self.temporaries.len();
        let parts = if self.plans.stands_in(callee) {
            self.library_call(function, &given)?
        } else if self.plans.is_word(callee) {
            self.word(callee, function, given)?
        } else if self.plans.is_written_out(callee) {
            self.write_out(callee, function, given)
                .map_err(|fault| fault.within(function.name.as_deref()))?
        } else {
            self.jump(callee, &given)?
        };
        if let Some(result) = result {
            self.keep(body, result, Known::Value(parts));
            self.trace(body, SiteKind::Expression(result), result)?;
        }
        self.drop_temporaries(mark);
        Ok(())
    }

    /// A word of a function of nothing but its arguments, which is written out once for all that use it in this block.
    fn word(
        &mut self,
        handle: Handle<Function>,
        function: &'m Function,
        given: Vec<Parts>,
    ) -> Result<Parts, Fault> {
        let (maker, of) = (Maker::Function(handle), given.concat());
        if let Some(known) = self.recall(maker, &of) {
            return Ok(vec![known]);
        }
        let parts = self
            .write_out(handle, function, given)
            .map_err(|fault| fault.within(function.name.as_deref()))?;
        if let &[result] = parts.as_slice() {
            self.remember(maker, of, result);
        }
        Ok(parts)
    }

    /// Writes a function out where it is called.
    fn write_out(
        &mut self,
        handle: Handle<Function>,
        function: &'m Function,
        given: Vec<Parts>,
    ) -> Result<Parts, Fault> {
        let before = self.owned_by(function);
        let mut body = Body::new(
            function,
            &self.info[handle],
            Some(handle),
            self.options.contraction,
        )?;
        body.arguments = given;
        body.returns = self.returns(&mut body, true)?;
        let gone = match body.returns {
            Returns::Leave(gone) => {
                self.pending.push(Vec::new());
                self.open_block();
                Some(gone)
            }
            _ => None,
        };
        self.begin(&mut body)?;
        self.statements(&mut body, &function.body)?;
        self.trace_results(&mut body)?;
        if let Some(gone) = gone {
            self.close_block();
            self.join_here();
            let next = self.here() + 1;
            self.emit(Inst::new(Op::Leave).to(gone).at(next));
            let end = self.emit(Inst::new(Op::Resume).to(gone));
            self.go_on_at_end(end);
            self.frame.release(gone);
            self.temporaries.extend(&body.results);
        }
        for handle in body.lifetimes.finish() {
            self.forget(&mut body, handle);
        }
        if body.returns == Returns::AtEnd {
            // they were retained when the body returned
            self.temporaries.extend(&body.results);
        }
        for first in std::mem::take(&mut body.locals) {
            self.release_row(first);
        }
        self.owner = before;
        Ok(body.results)
    }

    /// Calls a function that is translated by itself.
    fn jump(&mut self, callee: Handle<Function>, given: &[Parts]) -> Result<Parts, Fault> {
        let Some(compiled) = self.compiled.get(&callee) else {
            return Err(Fault::unsupported("a call of a function that comes later"));
        };
        let (entry, results) = (compiled.entry, compiled.results.clone());
        let places: Vec<Parts> = compiled.arguments.clone();
        for (&d, &a) in places.iter().flatten().zip(given.iter().flatten()) {
            self.emit(Inst::new(Op::Copy).to(d).of(a));
        }
        let saved = self.frame.take()?;
        self.emit(Inst::new(Op::Call).to(saved).at(entry));
        self.frame.release(saved);
        let mut parts = Vec::with_capacity(results.len());
        for slot in results {
            parts.push(if slot.is_uniform() {
                slot
            } else {
                let d = self.register()?;
                self.emit(Inst::new(Op::Copy).to(d).of(slot));
                d
            });
        }
        Ok(parts)
    }

    /// Calls what stands in for a function of the shader library.
    fn library_call(&mut self, function: &Function, given: &[Parts]) -> Result<Parts, Fault> {
        let unknown = || Fault::unsupported("a library function of this form");
        let stand = stand(function, &self.module.types).ok_or_else(unknown)?;
        let format = self.options.format;
        let width = if format == Format::Pair { 2 } else { 1 };
        let mut operands = Vec::new();
        for (argument, parts) in function.arguments.iter().zip(given) {
            let inner = &self.module.types[argument.ty].inner;
            let mut forms = Vec::new();
            self.shapes.forms(inner, &mut forms)?;
            operands.push(match (forms.as_slice(), parts.as_slice()) {
                ([Form::I32], &[n]) => Operand::Integer(n),
                ([first, ..], _) if !first.is_float() => Operand::Words(parts.clone()),
                (_, parts) if parts.len() == 2 * width => {
                    let (re, im) = parts.split_at(width);
                    Operand::Complex(re.to_vec(), im.to_vec())
                }
                (_, parts) => Operand::Real(parts.to_vec()),
            });
        }
        if let [Operand::Real(parts)] = operands.as_slice()
            && stand == Stand::Number(Meaning::Same)
            && function
                .result
                .as_ref()
                .is_some_and(|r| r.ty == function.arguments[0].ty)
        {
            return Ok(parts.clone());
        }
        let result = function.result.as_ref().ok_or_else(unknown)?;
        let count = self.shapes.size(result.ty)?;
        if count == 1
            && let Some(results) = self.native(stand, &operands)?
        {
            return Ok(results);
        }
        let all: Parts = given.iter().flatten().copied().collect();
        let results = (0..count)
            .map(|_| self.result_of(&all))
            .collect::<Result<Parts, _>>()?;
        let call = LibraryCall::new(stand, operands, results.clone(), format);
        self.library.push(call);
        let place = self.library.len() as u32 - 1;
        let d = results.first().copied().ok_or_else(unknown)?;
        self.emit(Inst::new(Op::Library).to(d).at(place));
        Ok(results)
    }
}
