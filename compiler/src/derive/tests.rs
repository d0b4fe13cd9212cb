//! Derivatives of loops against those of the same steps written out.

use super::{ComplexVariable, forward, jet, reverse};
use crate::eval::{Leaves, Tape};
use crate::ir::{
    Graph, Id, Loop, Op, Prim, Slopes, State, Ty, merge_loops, parse_text, to_text, verify,
};
use crate::reference::complex::complex;
use crate::table::Number;
use smallvec::smallvec;

/// Next states from the number of steps done and the states.
type Step = fn(&mut Graph, Id, &[Id]) -> Vec<Id>;

/// The states after some steps, as a loop or written out.
type Repeat = fn(&mut Graph, u32, &[Id], Step) -> Vec<Id>;

fn looped(g: &mut Graph, steps: u32, inits: &[Id], step: Step) -> Vec<Id> {
    let binder = g.binder();
    let leaves: Vec<Id> = inits
        .iter()
        .map(|&init| {
            let ty = g.ty(init);
            g.new_state(binder, ty)
        })
        .collect();
    let counter = g.counter(binder);
    let nexts = step(g, counter, &leaves);
    let states = leaves.iter().zip(inits).zip(nexts);
    let states = states.map(|((&leaf, &init), next)| State { leaf, init, next });
    let it = Loop {
        binder,
        count: g.real(f64::from(steps)),
        limit: steps,
        until: None,
        states: states.collect(),
    };
    let repeated = g.repeat(&it);
    leaves.iter().map(|&l| g.result(repeated, l)).collect()
}

fn written_out(g: &mut Graph, steps: u32, inits: &[Id], step: Step) -> Vec<Id> {
    let mut states = inits.to_vec();
    for k in 0..steps {
        let counter = g.real(f64::from(k));
        states = step(g, counter, &states);
    }
    states
}

fn evaluate(g: &Graph, roots: &[Id], inputs: &[Number]) -> Vec<(f64, f64)> {
    verify(g).unwrap();
    let leaves = Leaves {
        inputs,
        params: &[],
        time: 0.0,
        pixel: 0.0,
    };
    let mut out = Vec::new();
    Tape::new(g, roots).run(&leaves, |value| {
        out.push(match value {
            Number::Real(x) => (x, 0.0),
            Number::Complex(z) => (z.re, z.im),
            Number::Truth(t) => (f64::from(u8::from(t)), 0.0),
        });
    });
    out
}

fn assert_close(a: &[(f64, f64)], b: &[(f64, f64)]) {
    assert_eq!(a.len(), b.len());
    for (a, b) in a.iter().zip(b) {
        let size = b.0.abs().max(b.1.abs()).max(1e-3);
        assert!(
            (a.0 - b.0).abs() <= 1e-11 * size && (a.1 - b.1).abs() <= 1e-11 * size,
            "{a:?} {b:?}"
        );
    }
}

/// Two coupled reals, with the counter, an input, and a loop within that takes both.
fn coupled_by(g: &mut Graph, k: Id, s: &[Id], repeat: Repeat) -> Vec<Id> {
    let x = g.leaf(Op::Input(0), Ty::Real);
    let half = g.real(0.5);
    let sine = g.apply(Prim::Sin, &[s[1]]);
    let left = g.mul(half, sine);
    let left = g.add(left, x);
    let one = g.real(1.0);
    let below = g.add(k, one);
    let right = g.div(s[0], below);
    let inner = repeat(g, 3, &[right, s[0]], |g, j, t| {
        let product = g.mul(t[0], t[1]);
        let next = g.apply(Prim::Cos, &[product]);
        let sum = g.add(t[0], j);
        let quarter = g.real(0.25);
        vec![next, g.mul(quarter, sum)]
    });
    let right = g.add(inner[0], inner[1]);
    vec![left, right]
}

fn coupled(g: &mut Graph, k: Id, s: &[Id]) -> Vec<Id> {
    coupled_by(g, k, s, looped)
}

fn coupled_out(g: &mut Graph, k: Id, s: &[Id]) -> Vec<Id> {
    coupled_by(g, k, s, written_out)
}

/// Value, gradient and every second derivative by x and y, with starts y and x y.
fn second_order(build: impl Fn(&mut Graph, &[Id]) -> Vec<Id>) -> (Graph, Vec<Id>) {
    let mut g = Graph::new();
    let x = g.leaf(Op::Input(0), Ty::Real);
    let y = g.leaf(Op::Input(1), Ty::Real);
    let product = g.mul(x, y);
    let mut roots = build(&mut g, &[y, product]);
    let one = g.real(1.0);
    let zero = g.real(0.0);
    for a in [x, y] {
        let value = roots[1];
        let first = forward(&mut g, &[value], &[(a, one)]).unwrap()[0].unwrap_or(zero);
        roots.push(first);
        for b in [x, y] {
            let second = forward(&mut g, &[first], &[(b, one)]).unwrap()[0].unwrap_or(zero);
            roots.push(second);
        }
    }
    (g, roots)
}

#[test]
fn tangents_of_nested_loops_to_second_order() {
    let (a, ra) = second_order(|g, s| looped(g, 5, s, coupled));
    let (b, rb) = second_order(|g, s| written_out(g, 5, s, coupled_out));
    for (x, y) in [(0.3, -0.8), (1.5, 0.25), (-2.0, 3.0)] {
        let inputs = [Number::Real(x), Number::Real(y)];
        let (got, want) = (evaluate(&a, &ra, &inputs), evaluate(&b, &rb, &inputs));
        assert_close(&got, &want);
        assert!(want[2..].iter().all(|v| v.0 != 0.0));
    }
}

#[test]
fn value_and_all_tangents_share_one_loop_in_each_nesting() {
    let (g, roots) = second_order(|g, s| looped(g, 5, s, coupled));
    let loops = |g: &Graph, roots: &[Id]| {
        let live = g.reachable(roots);
        let is_live = |id: &Id| live[id.index()] && g.as_loop(*id).is_some();
        g.ids().filter(is_live).count()
    };
    let (merged, new_roots) = merge_loops(&g, &roots);
    verify(&merged).unwrap();
    assert_eq!(loops(&merged, &new_roots), 2);
    assert!(loops(&g, &roots) > 2);
    let inputs = [Number::Real(0.3), Number::Real(-0.8)];
    assert_eq!(
        evaluate(&g, &roots, &inputs),
        evaluate(&merged, &new_roots, &inputs)
    );
    let text = to_text(&merged, &new_roots);
    let (read, read_roots) = parse_text(&text).unwrap();
    verify(&read).unwrap();
    assert_eq!(to_text(&read, &read_roots), text);
    assert_eq!(
        evaluate(&merged, &new_roots, &inputs),
        evaluate(&read, &read_roots, &inputs)
    );
}

fn complex_jet(step: Step, build: Repeat) -> (Graph, Vec<Id>, bool) {
    let mut g = Graph::new();
    let z = g.leaf(Op::Input(0), Ty::Complex);
    let start = g.complex(0.25, -0.5);
    let one = g.complex(1.0, 0.0);
    let value = build(&mut g, 7, &[start, one], step)[0];
    let jet = jet(&mut g, value, ComplexVariable::Whole(z)).unwrap();
    let mut roots = vec![jet.value, jet.dz];
    roots.extend(jet.dzbar);
    (g, roots, jet.dzbar.is_some())
}

/// w² + z, with a second state that is not needed but for its own sake.
fn quadratic(g: &mut Graph, _: Id, s: &[Id]) -> Vec<Id> {
    let z = g.leaf(Op::Input(0), Ty::Complex);
    let square = g.apply(Prim::PowInt(2), &[s[0]]);
    vec![g.add(square, z), g.mul(s[1], s[0])]
}

/// w̄² + z k/8 and the second state with |w|.
fn tricorn(g: &mut Graph, k: Id, s: &[Id]) -> Vec<Id> {
    let z = g.leaf(Op::Input(0), Ty::Complex);
    let eighth = g.real(0.125);
    let k = g.mul(k, eighth);
    let shift = g.mul(z, k);
    let bar = g.apply(Prim::Conj, &[s[0]]);
    let square = g.mul(bar, s[1]);
    let size = g.apply(Prim::Abs, &[s[0]]);
    let next = g.add(square, shift);
    let turned = g.mul(next, size);
    vec![next, turned]
}

#[test]
fn jets_of_complex_loops() {
    for (step, general) in [(quadratic as Step, false), (tricorn as Step, true)] {
        let (a, ra, bar) = complex_jet(step, looped);
        let (b, rb, twin) = complex_jet(step, written_out);
        assert_eq!((bar, twin), (general, general));
        for z in [complex(-0.1, 0.65), complex(0.3, 0.2), complex(-1.2, -0.4)] {
            let inputs = [Number::Complex(z)];
            assert_close(&evaluate(&a, &ra, &inputs), &evaluate(&b, &rb, &inputs));
        }
    }
}

#[test]
fn states_that_no_result_needs_are_left_out() {
    let (g, roots, _) = complex_jet(quadratic, looped);
    let (small, new_roots) = g.compacted(&roots);
    let (small, _) = merge_loops(&small, &new_roots);
    let states = |id| small.as_loop(id).map(|it| it.states.len());
    assert_eq!(small.ids().filter_map(states).collect::<Vec<_>>(), [2]);
}

#[test]
fn derivatives_that_are_given_hold_where_the_rest_is_constant() {
    let mut g = Graph::new();
    let [x, y] = [0, 1].map(|k| g.leaf(Op::Input(k), Ty::Real));
    // not the true derivative, so that it is told from that
    let seven = g.real(7.0);
    let product = g.mul(x, y);
    let slopes = Slopes {
        by: smallvec![(x, seven)],
        fixed: smallvec![y],
    };
    g.set_slopes(product, slopes);
    let square = g.mul(product, product);
    let (mut g, roots) = g.compacted(&[square, x, y, seven]);
    let &[square, x, y, _] = roots.as_slice() else {
        panic!("four roots");
    };
    let one = g.real(1.0);
    let by_x = forward(&mut g, &[square], &[(x, one)]).unwrap()[0].unwrap();
    let by_y = forward(&mut g, &[square], &[(y, one)]).unwrap()[0].unwrap();
    let back = reverse(&mut g, square, &[x]).unwrap().unwrap()[0].unwrap();
    let both = reverse(&mut g, square, &[x, y]).unwrap().unwrap()[0].unwrap();
    let inputs = [3.0, 5.0].map(Number::Real);
    let found = evaluate(&g, &[by_x, by_y, back, both], &inputs);
    let reals: Vec<f64> = found.iter().map(|f| f.0).collect();
    assert_eq!(reals, [210.0, 90.0, 210.0, 150.0]);
}
