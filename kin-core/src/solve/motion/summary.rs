//! Summarises a motion: counts, Newton steps, residuals, and the distance of the first position
//! from the drawn one.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::Motion;
use crate::coordinates::layout::{Item, Kind};
use crate::numbers::algebra::{EulerParameters, Vec3};
use crate::outcome::error::surface::Surface;
use crate::outcome::motion::warning::{is_usual, shown};
use crate::outcome::motion::{Warning, WarningKind};
use crate::outcome::words::{count, number};

/// The largest number of bodies in a summary.
const SHOWN: usize = 4;

/// A body nearer to its drawn pose than this share of the mechanism's size, or than this part of a
/// radian, counts as unmoved. Users draw with about three digits. \[-\]
const THERE: f64 = 1e-3;

/// The distance between the guess and the first position of a body or a scalar angle.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Displacement {
    /// The name of the body or scalar coordinate.
    pub name: String,
    /// The distance between guess and first position; `None` if the user gave no position, as for a
    /// link with only a length. \[m\]
    pub moved: Option<f64>,
    /// The rotation between guess and first position; between 0 and π for a spatial body. \[rad\]
    pub turned: Option<f64>,
    /// The probable cause, if the first position is further from the guess than usual; otherwise
    /// `None`.
    pub hint: Option<String>,
}

impl Motion {
    /// Returns a summary of the motion in a few lines.
    ///
    /// The first line contains the counts, the Newton steps per time and the largest residual. The
    /// Newton steps of the first position are separate, because the run finds the first position
    /// from a guess. The next line describes the engine, if a program computed times or Kin could
    /// not compile a program ([`Motion::engine`], [`Motion::why_not_compiled`]). If the first
    /// position is far from the drawn position, the next lines list the bodies, the worst first
    /// ([`Motion::displaced`]), with a hint at a probable mistake. The last lines are the warnings
    /// among the events ([`crate::results::EventKind::is_warning`]).
    pub fn summary(&self) -> String {
        let mut text = self.counts() + &self.by_engine();
        let displaced = self.displaced();
        let unit = self.unit_words().length();
        let told: Vec<String> =
            displaced.iter().filter_map(|body| body.sentence(unit)).take(SHOWN).collect();
        if !told.is_empty() {
            text += &format!(
                "\n  distance of the first position from the initial guess: {}",
                told.join(", ")
            );
        }
        for warning in self.warnings() {
            text += &format!("\n  warning: {warning}");
        }
        text
    }

    /// Returns the line about the engine, or an empty text if the run did not look for a program.
    fn by_engine(&self) -> String {
        match (self.engine.compiled, self.why_not_compiled()) {
            (0, None) => String::new(),
            (0, Some(reason)) => format!("\n  engine: step by step, because {reason}"),
            (compiled, _) => {
                let back = match self.engine.handed_back {
                    0 => String::new(),
                    1 => ", and Kin returned to the step-by-step solver once".to_string(),
                    back => format!(", and Kin returned to the step-by-step solver {back} times"),
                };
                format!("\n  engine: {compiled} of {} compiled{back}", count(self.len(), "time"))
            }
        }
    }

    fn counts(&self) -> String {
        let (first, rest) = self.iterations.split_at(1.min(self.iterations.len()));
        let mut steps = if rest.is_empty() { first.to_vec() } else { rest.to_vec() };
        steps.sort_unstable();
        let most = steps.last().copied().unwrap_or(0);
        let newton = match (steps.get(steps.len() / 2).copied().unwrap_or(0), rest.is_empty()) {
            (_, true) => String::new(),
            (0, _) if most == 0 => "predictions satisfied the equations at all times, ".to_string(),
            (0, _) => format!(
                "predictions satisfied the equations at most times (otherwise at most {}), ",
                count(most, "Newton step")
            ),
            (usual, _) => format!("{} per time (at most {most}), ", count(usual, "Newton step")),
        };
        let largest = self.worst.map_or(0.0, |(residual, _)| residual);
        let breaks = match self.breaks.iter().map(|crossed| crossed.found.order).min() {
            Some(order) => {
                format!(", {} breaks of laws crossed (derivative {order} jumps)", self.breaks.len())
            }
            None => String::new(),
        };
        let misfit = match self.misfit {
            misfit if misfit > 0.0 => {
                format!(
                    ", allowed contradiction of the equations: {misfit:.1e} of the mechanism's size"
                )
            }
            _ => String::new(),
        };
        format!(
            "{}: {}, {}, {}, {newton}first position after {}, |C| ≤ {largest:.0e}{misfit}{breaks}",
            self.name,
            count(self.layout.len(), "coordinate"),
            count(self.equations.len(), "equation"),
            count(self.len(), "time"),
            count(first.first().copied().unwrap_or(0), "Newton step"),
        )
    }

    /// Returns the largest |C_i| relative to the norm of its row, if the options allow redundant
    /// equations to contradict each other ([`crate::SolverOptions::allowed_misfit`]). \[-\]
    ///
    /// For an equation of lengths, the norm is the mechanism's size. The result is 0 if all
    /// equations are satisfied.
    pub fn misfit(&self) -> f64 {
        self.misfit
    }

    /// Returns the distance between the guess and the first position of each body and scalar angle,
    /// the largest first.
    ///
    /// The order compares distances as shares of the mechanism's size with angles in radians. The
    /// list omits bodies that are at their guess.
    pub fn displaced(&self) -> Vec<Displacement> {
        self.displacements().into_iter().map(|(body, _)| body).collect()
    }

    /// The warnings about bodies whose first position is far from the guess.
    pub(super) fn far_from_drawn(&self) -> impl Iterator<Item = Warning> {
        let all = self.displacements().into_iter();
        all.filter_map(|(body, kind)| Some(Warning::new(kind?, &[&body.name], body.hint?)))
    }

    /// The same with the kind of the hint.
    fn displacements(&self) -> Vec<(Displacement, Option<WarningKind>)> {
        let guess = &self.guess;
        let first = self.q(0);
        if guess.len() != first.len() {
            return Vec::new();
        }
        let size = self.drawn_size();
        let mut all: Vec<(f64, Displacement, Option<WarningKind>)> =
            self.layout.items.iter().filter_map(|item| self.displacement(item, size)).collect();
        all.sort_by(|a, b| b.0.total_cmp(&a.0).then_with(|| a.1.name.cmp(&b.1.name)));
        all.into_iter().map(|(_, body, kind)| (body, kind)).collect()
    }

    /// One body with its share of what assembly has to do, and the kind of its hint; `None` where
    /// it is as it was guessed.
    fn displacement(
        &self,
        item: &Item,
        size: f64,
    ) -> Option<(f64, Displacement, Option<WarningKind>)> {
        let guess = &self.guess[..];
        let first = self.q(0);
        let drawn = is_drawn(item, guess);
        let (moved, turned) = match item.kind {
            Kind::Length => return None,
            Kind::Angle => (None, Some((first[item.first] - guess[item.first]).abs())),
            Kind::Planar | Kind::Spatial => {
                let a = origin(item, guess);
                let b = origin(item, first);
                let moved = a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
                let turned = match item.kind {
                    Kind::Planar => (first[item.first + 2] - guess[item.first + 2]).abs(),
                    _ => turn(
                        &guess[item.first + 3..item.first + 7],
                        &first[item.first + 3..item.first + 7],
                    ),
                };
                (drawn.then_some(moved), (drawn || turned > TAU).then_some(turned))
            }
        };
        let shares = [
            moved.map(|moved| if size > 0.0 { moved / size } else { 0.0 }),
            turned.map(|turned| turned / PI),
        ];
        let share = shares.into_iter().flatten().fold(0.0, f64::max);
        if share <= THERE {
            return None;
        }
        let moved = moved.filter(|moved| *moved > THERE * size);
        let odd = turned.filter(|turned| !(*turned > TAU && self.turn_is_meant(item, *turned)));
        let hint = hint(item, moved, odd, (size, self.unit_words().length()));
        let (kind, hint) = hint.unzip();
        Some((share, Displacement { name: item.name.clone(), moved, turned, hint }, kind))
    }

    /// True if more than a turn from the guess is no slip: the angle is one that people write in
    /// radians, or a driver has turned so far since t = 0.
    fn turn_is_meant(&self, item: &Item, turned: f64) -> bool {
        let angle = match item.kind {
            Kind::Angle => self.q(0)[item.first],
            Kind::Planar => self.q(0)[item.first + 2],
            Kind::Spatial | Kind::Length => return true,
        };
        self.turned_before || is_usual(turned) || angle.abs() > TAU && is_usual(angle)
    }

    /// Returns the largest distance of drawn bodies from one another and from the origin, or 0 if
    /// no body is drawn.
    fn drawn_size(&self) -> f64 {
        let drawn = self
            .layout
            .items
            .iter()
            .filter(|item| is_drawn(item, &self.guess))
            .map(|item| origin(item, &self.guess));
        let origins: Vec<[f64; 3]> = drawn.collect();
        let spread = |k: usize| {
            let (low, high) = origins
                .iter()
                .fold((0.0_f64, 0.0_f64), |(low, high), r| (low.min(r[k]), high.max(r[k])));
            high - low
        };
        spread(0).hypot(spread(1)).hypot(spread(2))
    }
}

impl Displacement {
    /// Writes "`plate` 2.50 m and 0.30 rad".
    fn sentence(&self, unit: &str) -> Option<String> {
        let length = self
            .moved
            .filter(|moved| *moved > 0.0)
            .map(|moved| format!("{} {unit}", number(moved)));
        let angle =
            self.turned.filter(|turned| *turned > THERE).map(|turned| format!("{turned:.3} rad"));
        let both: Vec<String> = length.into_iter().chain(angle).collect();
        (!both.is_empty()).then(|| format!("`{}` {}", self.name, both.join(" and ")))
    }
}

/// Returns true if the user gave a pose for a body. Links given by their length alone are at the
/// origin before assembly.
fn is_drawn(item: &Item, guess: &[f64]) -> bool {
    match item.kind {
        Kind::Planar | Kind::Spatial => origin(item, guess) != [0.0; 3],
        Kind::Angle | Kind::Length => false,
    }
}

fn origin(item: &Item, q: &[f64]) -> [f64; 3] {
    let z = if item.kind == Kind::Spatial { q[item.first + 2] } else { 0.0 };
    [q[item.first], q[item.first + 1], z]
}

/// Returns the angle between two orientations, from 0 to π. \[rad\]
fn turn(a: &[f64], b: &[f64]) -> f64 {
    let [a, b] = [a, b].map(|p| EulerParameters::new(p[0], p[1], p[2], p[3]));
    let relative = a.conjugate().product(b);
    let vector: Vec3 = relative.vector();
    2.0 * vector.norm().atan2(relative.e0.abs())
}

/// The likely slip, and what to do about it.
fn hint(
    item: &Item,
    moved: Option<f64>,
    turned: Option<f64>,
    (size, unit): (f64, &str),
) -> Option<(WarningKind, String)> {
    let name = &item.name;
    let surface = Surface::chosen();
    match (moved, turned) {
        (_, Some(turned)) if item.kind != Kind::Spatial && turned > TAU => {
            let text = format!(
                "`{name}` begins {turned:.1} rad from its initial guess, which is more than a turn. Angles are in radians; if degrees are meant, {:.1}° is {}.",
                shown(turned),
                surface.angle(shown(turned))
            );
            Some((WarningKind::Degrees, text))
        }
        (Some(moved), _) if size > 0.0 && moved > 0.5 * size => {
            let text = format!(
                "The first position of `{name}` is {moved:.3} {unit} from its initial guess, more than half the mechanism's size. {}.",
                surface.in_body("local", name, "point")
            );
            Some((WarningKind::FarFromDrawn, text))
        }
        (_, Some(turned)) if item.kind == Kind::Spatial && turned > FRAC_PI_2 - THERE => {
            let text = format!(
                "The first position of `{name}` is turned by {turned:.3} rad from its initial guess. {}.",
                surface.in_body("local_direction", name, "h")
            );
            Some((WarningKind::FarFromDrawn, text))
        }
        _ => None,
    }
}
