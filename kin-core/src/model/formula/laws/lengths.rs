//! Determines which laws of a formula are lengths and which are angles or numbers.
//!
//! Kin derives the power of the unit of length of each law from the units of the rows and
//! coordinates, because operands of a sum or a comparison have the same unit.

use std::cell::RefCell;
use std::ops::{Add, Div, Mul, Neg, Sub};
use std::rc::Rc;

use kin_graph::{
    Comparison, Formula, Function, Function2, Input, LeafUse, Number, Source, evaluate,
};

/// The largest difference of two equal powers. Powers are small fractions, so only rounding
/// separates them. \[-\]
const SAME: f64 = 1e-9;

/// Linear equations over the unknown powers of parameters and laws. The last number is the
/// constant; each sum is zero.
type Equations = Rc<RefCell<Vec<Vec<f64>>>>;

/// The power of the unit of length in a number.
#[derive(Clone)]
enum Power {
    /// The power of zero, which has any unit, and of a value that only the program knows.
    Any,
    /// The power of a plain number, which may also be added to a length.
    Plain,
    /// A sum over the unknown powers, with a constant at the end.
    Sum(Vec<f64>, Equations),
}

use Power::{Any, Plain, Sum};

impl Power {
    /// Records that the power is 0.
    fn meets_zero(self) -> Power {
        if let Sum(power, equations) = self {
            equations.borrow_mut().push(power);
        }
        Plain
    }

    fn times(self, factor: f64) -> Power {
        match self {
            Sum(power, equations) => {
                Sum(power.into_iter().map(|x| factor * x).collect(), equations)
            }
            other => other,
        }
    }

    /// Returns the power of two operands with the same unit.
    fn alike(self, other: Power) -> Power {
        match (self, other) {
            (Sum(a, equations), Sum(b, _)) => {
                equations.borrow_mut().push(a.iter().zip(b).map(|(a, b)| a - b).collect());
                Sum(a, equations)
            }
            (Any | Plain, b @ Sum(..)) => b,
            (Any, b) => b,
            (a, _) => a,
        }
    }

    /// Returns the power of a product (`sign` 1) or of a quotient (`sign` −1).
    fn with(self, other: Power, sign: f64) -> Power {
        match (self, other) {
            (Any, _) | (_, Any) => Any,
            (Sum(a, equations), Sum(b, _)) => {
                Sum(a.iter().zip(b).map(|(a, b)| a + sign * b).collect(), equations)
            }
            (a, Plain) => a,
            (Plain, b) => b.times(sign),
        }
    }
}

impl Add for Power {
    type Output = Power;

    fn add(self, other: Power) -> Power {
        self.alike(other)
    }
}

impl Sub for Power {
    type Output = Power;

    fn sub(self, other: Power) -> Power {
        self.alike(other)
    }
}

impl Mul for Power {
    type Output = Power;

    fn mul(self, other: Power) -> Power {
        self.with(other, 1.0)
    }
}

impl Div for Power {
    type Output = Power;

    fn div(self, other: Power) -> Power {
        self.with(other, -1.0)
    }
}

impl Neg for Power {
    type Output = Power;

    fn neg(self) -> Power {
        self
    }
}

impl Number for Power {
    type Condition = bool;

    fn constant(x: f64) -> Power {
        if x == 0.0 { Any } else { Plain }
    }

    fn call(self, f: Function) -> Power {
        match f {
            Function::Abs => self,
            Function::Sqrt => self.times(0.5),
            _ => self.meets_zero(),
        }
    }

    fn call2(self, f: Function2, other: Power) -> Power {
        match f {
            Function2::Max | Function2::Min | Function2::Hypot => self.alike(other),
            Function2::Atan2 => {
                let _ = self.alike(other);
                Plain
            }
            _ => {
                let _ = (self.meets_zero(), other.meets_zero());
                Plain
            }
        }
    }

    fn powi(self, n: i32) -> Power {
        self.times(f64::from(n))
    }

    fn compare(_: Comparison, a: &Power, b: &Power) -> bool {
        let _ = a.clone().alike(b.clone());
        true
    }

    fn select(_: &bool, a: Power, b: Power) -> Power {
        a.alike(b)
    }

    fn of_condition(_: &bool) -> Power {
        Plain
    }

    fn holds(&self) -> bool {
        true
    }
}

/// The inputs: coordinates with known powers, parameters and laws with unknown powers.
struct Asked<'a> {
    columns: &'a [f64],
    parameters: usize,
    laws: &'a [usize],
    equations: Equations,
}

impl Asked<'_> {
    fn unknown(&self) -> usize {
        self.parameters + self.laws.len()
    }

    fn number(&self, power: f64) -> Power {
        let mut sum = vec![0.0; self.unknown() + 1];
        sum[self.unknown()] = power;
        Sum(sum, self.equations.clone())
    }

    fn one(&self, k: usize) -> Power {
        let mut sum = vec![0.0; self.unknown() + 1];
        sum[k] = 1.0;
        Sum(sum, self.equations.clone())
    }
}

impl Source<Power> for Asked<'_> {
    fn input(&self, input: Input) -> Power {
        match input {
            Input::Column(k) => self.columns.get(k).map_or(Any, |power| self.number(*power)),
            Input::Parameter(k) if k < self.parameters => self.one(k),
            Input::Time => self.number(0.0),
            _ => Any,
        }
    }

    fn law(&self, law: usize, x: Power, order: u8) -> Power {
        match self.laws.iter().position(|known| *known == law) {
            Some(k) => self.one(self.parameters + k) / x.times(f64::from(order)),
            None => Any,
        }
    }

    fn opaque(&self, _: usize, _: usize, _: Vec<Power>) -> Power {
        Any
    }

    fn leaf(&self, _: LeafUse, _: Vec<Power>) -> Power {
        Any
    }
}

/// Returns the power of the unit of length of each law, 1 for a length and 0 for an angle. Returns
/// `None` if the formulas do not determine it. `columns` and `rows` are the powers of coordinates
/// and rows, as far as they are known.
pub(crate) fn lengths(
    formula: &Formula,
    laws: &[usize],
    columns: &[f64],
    rows: &[Option<f64>],
) -> Vec<Option<f64>> {
    let parameters = formula.parameters.len();
    let asked = Asked { columns, parameters, laws, equations: Equations::default() };
    let results = evaluate(&formula.graph, &formula.rows, &asked);
    for (row, known) in formula.rows.iter().zip(rows) {
        if let (Some(power), Some(known)) = (results.number(*row), known) {
            let _ = power.alike(asked.number(*known));
        }
    }
    match solved(asked.equations.take(), asked.unknown()) {
        Some(all) => all[parameters..].to_vec(),
        None => vec![None; laws.len()],
    }
}

/// Returns the unknowns that the equations determine, by elimination. Returns `None` if the
/// equations contradict each other.
fn solved(mut equations: Vec<Vec<f64>>, unknown: usize) -> Option<Vec<Option<f64>>> {
    let mut pivots: Vec<(usize, Vec<f64>)> = Vec::new();
    while let Some(mut row) = equations.pop() {
        for (k, pivot) in &pivots {
            let factor = row[*k];
            row.iter_mut().zip(pivot).for_each(|(x, own)| *x -= factor * own);
        }
        let Some(k) = (0..unknown).find(|k| row[*k].abs() > SAME) else {
            if row[unknown].abs() > SAME {
                return None;
            }
            continue;
        };
        let scale = row[k];
        row.iter_mut().for_each(|x| *x /= scale);
        for (_, pivot) in &mut pivots {
            let factor = pivot[k];
            pivot.iter_mut().zip(&row).for_each(|(x, own)| *x -= factor * own);
        }
        pivots.push((k, row));
    }
    let mut all = vec![None; unknown];
    for (k, row) in pivots {
        let is_alone = (0..unknown).all(|other| other == k || row[other].abs() <= SAME);
        all[k] = is_alone.then(|| 0.0 - row[unknown]);
    }
    Some(all)
}
