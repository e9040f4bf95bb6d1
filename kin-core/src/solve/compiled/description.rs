//! Describes the compiled program of a mechanism: the coordinates that rows determine, the
//! coordinates that remain for Newton's method, and the size of the program.

use std::fmt;

use super::{can_be, programs, refused};
use crate::outcome::error::Result;
use crate::solve::newton::{Newton, first_position};
use crate::solve::options::SolverOptions;
use crate::system::System;

/// The compiled program of a mechanism, which [`crate::Engine::Compiled`] runs.
///
/// ```
/// use kin::prelude::*;
/// let mut m = Mechanism::new("crank");
/// let crank = m.link("crank", 1.0)?;
/// m.add("O", revolute(Ground, crank, vec2(0.0, 0.0), crank.start()))?;
/// m.add("motor", drive_angle(crank, Law::ramp(2.0)))?;
/// let compiled = m.build()?.compile()?;
/// assert!(compiled.unknowns().is_empty() && compiled.substituted().len() == 3);
/// # Ok::<(), kin::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Compiled {
    name: String,
    substituted: Vec<String>,
    unknowns: Vec<String>,
    blocks: Vec<usize>,
    size: [usize; 2],
}

impl System {
    /// Compiles all equations to one program and returns its description.
    ///
    /// Kin chooses the order of elimination at the position of t = 0.
    ///
    /// The system keeps the program until you set a value of the system. Runs of at least 32 times
    /// that begin at the position of t = 0 use the program. [`System::solve_at`] uses the program
    /// for positions near a known position, unless [`crate::SolverOptions::engine`] is
    /// [`crate::Engine::StepByStep`]. Call this method before a loop that computes one position
    /// after the other, such as a controller.
    ///
    /// Errors: Kin cannot compile a constraint (the error names the constraint and the reason); the
    /// mechanism has no position at t = 0.
    pub fn compile(&self) -> Result<Compiled> {
        let options = SolverOptions::default();
        can_be(self).map_err(|refusal| refused(&refusal))?;
        let mut newton = Newton::new(self, &options);
        first_position::assemble(&mut newton, 0.0)?;
        let asked = programs::ask(&newton, 0.0);
        let tape = asked.map_err(|refusal| refused(&refusal))?;
        let names = self.coordinate_names();
        let is_torn = |column: &usize| tape.torn().contains(column);
        let named = |wanted: bool| {
            (0..names.len()).filter(|k| is_torn(k) == wanted).map(|k| names[k].clone()).collect()
        };
        let substituted = named(false);
        let unknowns = named(true);
        Ok(Compiled {
            name: self.name().to_string(),
            substituted,
            unknowns,
            blocks: tape.blocks().to_vec(),
            size: tape.size(),
        })
    }
}

impl Compiled {
    /// Returns the coordinates that a row determines from earlier coordinates, without iteration.
    pub fn substituted(&self) -> &[String] {
        &self.substituted
    }

    /// Returns the coordinates that remain for Newton's method.
    pub fn unknowns(&self) -> &[String] {
        &self.unknowns
    }

    /// Returns the number of coordinates of each block.
    ///
    /// The program solves the coordinates of a block together, and the blocks one after the other.
    pub fn blocks(&self) -> &[usize] {
        &self.blocks
    }

    /// Returns the number of steps of the program.
    ///
    /// A step is one operation or function on many times at once.
    pub fn steps(&self) -> usize {
        self.size[0]
    }

    /// Returns a summary of the program in a few lines.
    pub fn summary(&self) -> String {
        let given = self.substituted.len();
        let left = self.unknowns.len();
        let mut text = format!(
            "{}: {given} of {} coordinates have an explicit equation",
            self.name,
            given + left
        );
        if left > 0 {
            let blocks: Vec<String> = self.blocks.iter().map(usize::to_string).collect();
            text += &format!(
                ", Newton's method solves {left} coordinates in blocks of {}: {}",
                blocks.join(", "),
                self.unknowns.join(", ")
            );
        }
        text + &format!(
            "\n  {} operations in {} groups of independent operations",
            self.size[0], self.size[1]
        )
    }
}

impl fmt::Display for Compiled {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.summary())
    }
}
