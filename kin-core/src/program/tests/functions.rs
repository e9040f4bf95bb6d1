//! A function of one or two numbers as a tape computes it in lanes.

use kin_graph::{Graph, Input, Node};
use pulp::NullaryFnOnce;

use crate::numbers::lanes::{Lanes, Level, Wide, WithLevel};
use crate::program::kind::SELF;
use crate::program::tape::replay::Replay;
use crate::program::tape::{SHORT, Straight, straight};

/// The values of what `make` makes of numbers, a row of them for each value; `None` where the
/// machine does not have these lanes.
pub(crate) fn in_lanes<const N: usize>(
    lanes: Lanes,
    rows: &[[f64; N]],
    make: impl FnOnce(&mut Graph, [Node; N]) -> Node,
) -> Option<Vec<f64>> {
    let mut graph = Graph::default();
    let inputs = std::array::from_fn(|k| graph.input(Input::State(k, SELF)));
    let value = make(&mut graph, inputs);
    let tape = straight(graph, Vec::new(), &[value]);
    lanes.dispatch(All { tape: &tape, rows }).ok()
}

struct All<'a, const N: usize> {
    tape: &'a Straight,
    rows: &'a [[f64; N]],
}

impl<const N: usize> WithLevel for All<'_, N> {
    type Output = Vec<f64>;

    fn run<S: Level>(self, simd: S) -> Vec<f64> {
        let All { tape, rows } = self;
        let mut memory = vec![Wide::splat(simd, f64::NAN); tape.places.max(SHORT)];
        tape.constants
            .iter()
            .for_each(|(place, x)| memory[*place as usize] = Wide::splat(simd, *x));
        let mut values = Vec::with_capacity(rows.len());
        for group in rows.chunks(Wide::<S>::LANES) {
            for (input, place) in &tape.inputs {
                let Input::State(column, _) = input else { panic!("{input:?}") };
                let own = memory[*place as usize].as_mut_slice().iter_mut();
                own.zip(group).for_each(|(x, row)| *x = row[*column]);
            }
            let replay = Replay { stage: &tape.stage, laws: &tape.laws, memory: &mut memory };
            simd.vectorize(Again(replay));
            values.extend_from_slice(&memory[tape.outputs[0] as usize].as_slice()[..group.len()]);
        }
        values
    }
}

/// A replay on its way into the function that has the machine's instructions.
pub(super) struct Again<'a, S: Level>(pub Replay<'a, Wide<S>>);

impl<S: Level> NullaryFnOnce for Again<'_, S> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        self.0.call();
    }
}
