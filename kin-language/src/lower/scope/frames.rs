//! The frames around the present position, and the conditions that hold there.

use kin_graph::Node;

use super::store::{Changes, Mark};

/// A part of the body that can be left.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Kind {
    Function,
    Loop,
    /// One turn of a loop.
    Turn,
    Block,
}

/// A part of the body that the code can leave before its end, while the interpreter reads it.
pub struct Frame<V> {
    pub kind: Kind,
    pub label: Option<String>,
    pub exits: Vec<Exit<V>>,
    /// The length of [`Frames::path`] at the beginning of the frame.
    pub path: usize,
    /// The position in the log of variables at the beginning of the frame.
    pub since: Mark,
}

/// An exit from a frame: the condition, the value of the frame, and the changed variables.
pub struct Exit<V> {
    pub condition: Node,
    pub value: V,
    pub changes: Changes<V>,
}

/// A condition that holds at the present position: of a branch around it, or that the code has not
/// left a frame.
#[derive(Clone, Copy)]
pub struct Guard {
    pub holds: Node,
    /// The number of the frame that the code has not left, or `None` for a branch.
    pub left: Option<usize>,
}

impl Guard {
    pub fn branch(holds: Node) -> Self {
        Guard { holds, left: None }
    }
}

/// The frames around the present position, and the conditions that hold there.
#[derive(Default)]
pub struct Frames<V> {
    /// The frames, outermost first.
    pub frames: Vec<Frame<V>>,
    /// The conditions, from the branches and frames around the position.
    pub path: Vec<Guard>,
}

impl<V> Frames<V> {
    /// Returns the conditions that hold at the present position.
    pub fn conditions(&self) -> Vec<Node> {
        self.path.iter().map(|guard| guard.holds).collect()
    }

    /// Returns how many exits of the innermost frame have been found.
    pub fn exits(&self) -> usize {
        self.frames.last().map_or(0, |frame| frame.exits.len())
    }

    /// Returns the labels of the loops and blocks around the present position.
    pub fn labels(&self) -> impl Iterator<Item = &str> {
        self.frames.iter().filter_map(|frame| frame.label.as_deref())
    }

    /// Returns the number of the frame that a statement leaves.
    pub fn frame(&self, wanted: impl Fn(Kind) -> bool, label: Option<&str>) -> Option<usize> {
        let function =
            self.frames.iter().rposition(|frame| frame.kind == Kind::Function).unwrap_or(0);
        let fits = |frame: &Frame<V>| {
            wanted(frame.kind) && (label.is_none() || frame.label.as_deref() == label)
        };
        (function..self.frames.len()).rev().find(|&k| fits(&self.frames[k]))
    }
}

#[cfg(test)]
mod tests {
    use super::{Frame, Frames, Kind};
    use crate::lower::scope::Store;

    #[test]
    fn a_label_finds_its_frame_within_the_function() {
        let mut store = Store::<f64>::default();
        let mut flow = Frames::<f64>::default();
        for (kind, label) in
            [(Kind::Loop, Some("'out")), (Kind::Function, None), (Kind::Loop, Some("'row"))]
        {
            let label = label.map(String::from);
            let since = store.begin();
            flow.frames.push(Frame { kind, label, exits: vec![], path: 0, since });
        }
        let is_loop = |kind| kind == Kind::Loop;
        assert_eq!(flow.frame(is_loop, Some("'row")), Some(2));
        assert_eq!(flow.frame(is_loop, Some("'out")), None);
        assert_eq!(flow.labels().collect::<Vec<_>>(), ["'out", "'row"]);
    }
}
