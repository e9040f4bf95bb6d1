//! Orders the steps of a program without a change of the results, with steps of one shape together.

use std::collections::HashMap;

use super::active::NONE;
use super::code::Shape;

/// A step, as far as its order is concerned.
pub(crate) struct Ordered {
    pub shape: Shape,
    pub out: u32,
    /// All places that it reads.
    pub reads: Vec<u32>,
}

/// Returns the indices of the steps in the order of execution. Among the steps that may run next it
/// takes one of the present shape, or else one of the most frequent shape.
pub(crate) fn order(steps: &[Ordered]) -> Vec<u32> {
    let mut waiting = Waiting::new(steps);
    let mut ready = Ready::default();
    (0..steps.len())
        .filter(|&k| waiting.counts[k] == 0)
        .for_each(|k| ready.put(steps[k].shape, k as u32));
    let mut order = Vec::with_capacity(steps.len());
    while let Some(k) = ready.take() {
        order.push(k);
        waiting.release(k, |freed| ready.put(steps[freed as usize].shape, freed));
    }
    order
}

/// The dependencies of steps.
struct Waiting {
    /// For each step the number of steps that must run before it.
    counts: Vec<u32>,
    /// For each step the first link to a step that waits for it; `links` contains (step, next
    /// link).
    first: Vec<u32>,
    links: Vec<(u32, u32)>,
}

impl Waiting {
    /// Computes the dependencies: a step waits for the one that writes what it reads, and for all
    /// steps that read or write its output before it.
    fn new(steps: &[Ordered]) -> Self {
        let mut waiting = Waiting {
            counts: vec![0; steps.len()],
            first: vec![NONE; steps.len()],
            links: Vec::new(),
        };
        let places = steps
            .iter()
            .flat_map(|step| step.reads.iter().chain([&step.out]))
            .max()
            .map_or(0, |last| *last as usize + 1);
        // For each place the step that has written it and the steps that have read that: linked
        // lists of (step, next).
        let mut writer = vec![NONE; places];
        let mut readers = vec![NONE; places];
        let mut reads = Vec::<(u32, u32)>::new();
        for (k, step) in (0..).zip(steps) {
            for place in step
                .reads
                .iter()
                .map(|place| *place as usize)
                .filter(|place| writer[*place] != NONE)
            {
                waiting.wait(k, writer[place]);
            }
            let out = step.out as usize;
            let mut next = std::mem::replace(&mut readers[out], NONE);
            while next != NONE {
                let (before, after) = reads[next as usize];
                waiting.wait(k, before);
                next = after;
            }
            let before = std::mem::replace(&mut writer[out], k);
            if before != NONE {
                waiting.wait(k, before);
            }
            for place in &step.reads {
                let next = std::mem::replace(&mut readers[*place as usize], reads.len() as u32);
                reads.push((k, next));
            }
        }
        waiting
    }

    fn wait(&mut self, step: u32, before: u32) {
        if step != before {
            self.counts[step as usize] += 1;
            let next = std::mem::replace(&mut self.first[before as usize], self.links.len() as u32);
            self.links.push((step, next));
        }
    }

    /// Releases the steps that wait for nothing after this step has run.
    fn release(&mut self, step: u32, mut freed: impl FnMut(u32)) {
        let mut link = self.first[step as usize];
        while link != NONE {
            let (waiting, next) = self.links[link as usize];
            self.counts[waiting as usize] -= 1;
            if self.counts[waiting as usize] == 0 {
                freed(waiting);
            }
            link = next;
        }
    }
}

/// The steps that may run, by their shapes.
#[derive(Default)]
struct Ready {
    number: HashMap<Shape, usize>,
    queues: Vec<std::collections::VecDeque<u32>>,
    current: usize,
}

impl Ready {
    fn put(&mut self, shape: Shape, step: u32) {
        let number = *self.number.entry(shape).or_insert(self.queues.len());
        if number == self.queues.len() {
            self.queues.push(Default::default());
        }
        self.queues[number].push_back(step);
    }

    fn take(&mut self) -> Option<u32> {
        if let Some(step) = self.queues.get_mut(self.current).and_then(|queue| queue.pop_front()) {
            return Some(step);
        }
        // The first of the longest queues, so that the order is always the same.
        self.current = (0..self.queues.len()).rev().max_by_key(|&k| self.queues[k].len())?;
        self.queues[self.current].pop_front()
    }
}

#[cfg(test)]
mod tests {
    use super::super::program::Kind;
    use super::*;

    fn step(products: usize, out: u32, reads: &[u32]) -> Ordered {
        Ordered {
            shape: Shape { kind: Kind::Plain, products, plus: 0, minus: 0 },
            out,
            reads: reads.to_vec(),
        }
    }

    #[test]
    fn steps_of_one_shape_come_together_where_results_allow_it() {
        let steps = [step(0, 10, &[0]), step(1, 11, &[10]), step(0, 12, &[1]), step(1, 13, &[12])];
        assert_eq!(order(&steps), [0, 2, 1, 3]);
    }

    #[test]
    fn a_place_is_written_again_only_after_all_have_read_it() {
        let steps = [step(0, 10, &[0]), step(1, 11, &[10]), step(0, 10, &[1]), step(1, 12, &[10])];
        assert_eq!(order(&steps), [0, 1, 2, 3]);
    }
}
