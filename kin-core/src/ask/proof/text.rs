//! Writes a proof in words.

use std::fmt;

use super::{Proof, Tube, Unproved, UnprovedReason};
use crate::coordinates::units::Unit;
use crate::outcome::words::{count, joined, time};

/// Writes the verdict, and the first step without a proof.
pub(super) fn proof(proof: &Proof, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    let all = proof.steps.len();
    let proved = proof.proved();
    let s = proof.words.time();
    let ends = proof
        .steps
        .first()
        .zip(proof.steps.last())
        .map(|(first, last)| (time(first.from), time(last.to)));
    match ends {
        Some((from, to)) if proved == all => write!(
            f,
            "{}: {} proved. From t = {from} {s} to {to} {s} exactly one continuous motion passes through the computed positions.",
            proof.name,
            if all == 1 { "the step is".to_string() } else { format!("all {all} steps are") }
        )?,
        Some(_) => write!(f, "{}: Kin proved {proved} of {}.", proof.name, count(all, "step"))?,
        None => {
            let found = proof.positions.iter().filter(|position| position.is_ok()).count();
            write!(
                f,
                "{}: Kin proved {found} of {}.",
                proof.name,
                count(proof.positions.len(), "position")
            )?;
        }
    }
    let tubes: Vec<&Tube> = proof.steps.iter().filter_map(|step| step.tube.as_ref().ok()).collect();
    let positions: Vec<&Tube> =
        proof.positions.iter().filter_map(|position| position.as_ref().ok()).collect();
    let largest = |tubes: &[&Tube]| {
        sizes(proof, &|k| tubes.iter().fold(0.0, |m, tube| tube.radius[k].max(m)), f64::max, above)
    };
    let least = |tubes: &[&Tube]| {
        sizes(
            proof,
            &|k| tubes.iter().fold(f64::INFINITY, |m, tube| tube.free[k].min(m)),
            f64::min,
            below,
        )
    };
    if !tubes.is_empty() {
        let radius = largest(&tubes);
        let alone = least(&tubes);
        write!(
            f,
            "\n  The proved motion is within {radius} of the interpolated positions. No other motion comes within {alone} of the proved motion."
        )?;
    }
    if !positions.is_empty() {
        write!(f, "\n  The computed positions deviate by at most {}.", largest(&positions))?;
    }
    if !proof.trusted.is_empty() {
        write!(f, "\n  This proof relies on the bounds of {}.", joined(&proof.trusted, "and"))?;
    }
    if let Some(step) = proof.first_unproved() {
        let number = step.step + 1;
        let from = time(step.from);
        let to = time(step.to);
        write!(
            f,
            "\n  The first step without proof is step {number}, from t = {from} {s} to {to} {s}"
        )?;
    }
    let unproved = proof.first_unproved().and_then(|step| step.tube.as_ref().err());
    let doubt =
        unproved.or_else(|| proof.positions.iter().find_map(|position| position.as_ref().err()));
    doubt.map_or(Ok(()), |doubt| {
        write!(f, "{}{doubt}", if unproved.is_some() { ". " } else { "\n  " })
    })
}

/// Returns the sizes of lengths, angles and Euler parameters, as far as there are such coordinates.
fn sizes(
    proof: &Proof,
    of: &dyn Fn(usize) -> f64,
    join: fn(f64, f64) -> f64,
    rounded: fn(f64) -> String,
) -> String {
    let of = |unit: Unit| {
        (0..proof.units.len()).filter(|k| proof.units[*k] == unit).map(of).reduce(join)
    };
    let names = [
        (Unit::Metre, proof.words.length()),
        (Unit::Radian, "rad"),
        (Unit::One, "in Euler parameters"),
    ];
    let texts =
        names.into_iter().filter_map(|(unit, name)| Some(format!("{} {name}", rounded(of(unit)?))));
    texts.collect::<Vec<_>>().join(" and ")
}

/// Writes a number of two digits that is not below x.
fn above(x: f64) -> String {
    rounded(x, 1.0)
}

/// Writes a number of two digits that is not above x.
fn below(x: f64) -> String {
    rounded(x, -1.0)
}

fn rounded(x: f64, sense: f64) -> String {
    let text = format!("{x:.1e}");
    let is_beyond = |text: &str| text.parse::<f64>().is_ok_and(|shown| sense * shown >= sense * x);
    let power =
        format!("{x:e}").split_once('e').and_then(|(_, power)| power.parse().ok()).unwrap_or(0);
    // Half a unit of the second digit further, it is rounded to the next number.
    if is_beyond(&text) { text } else { format!("{:.1e}", x + sense * 0.05 * 10_f64.powi(power)) }
}

impl fmt::Display for Unproved {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let t = time(self.t);
        let s = self.units.time();
        match &self.reason {
            UnprovedReason::Singular { coordinate } => {
                write!(
                    f,
                    "Near t = {t} {s} the pose may be singular, and `{coordinate}` can move most easily at this pose."
                )
            }
            UnprovedReason::Apart { equation, by } => write!(
                f,
                "Near t = {t} {s} the interpolated positions violate `{equation}` by {by:.1e} (in the unit of this equation). The ends of the step may be on different branches, or the step is too large."
            ),
            UnprovedReason::Unbounded { equation, expression, source } => {
                write!(f, "Near t = {t} {s} Kin knows no bounds of `{equation}`")?;
                if let Some(expression) = expression {
                    write!(f, ": `{expression}` jumps near this time, or has no value or slope")?;
                }
                source.map_or(Ok(()), |source| write!(f, " ({source})"))?;
                f.write_str(".")
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ask::proof::StepProof;
    use crate::coordinates::units::Units;
    use crate::model::blame::Source;
    use crate::numbers::enclosure::interval::down;

    fn tube(radius: [f64; 3], alone: [f64; 3]) -> Tube {
        let free = alone.iter().zip(radius).map(|(alone, radius)| down(alone - radius)).collect();
        Tube { radius: radius.to_vec(), alone: alone.to_vec(), free }
    }

    fn doubt(t: f64, reason: UnprovedReason) -> Unproved {
        Unproved { t, units: Units::default(), reason }
    }

    fn proof_of(
        steps: Vec<Result<Tube, Unproved>>,
        positions: Vec<Result<Tube, Unproved>>,
        trusted: &[&str],
    ) -> String {
        let step = |(k, tube)| StepProof { step: k, from: k as f64, to: k as f64 + 1.0, tube };
        let proof = Proof {
            name: "crank".to_string(),
            units: vec![Unit::Metre, Unit::Radian, Unit::Metre],
            words: Units::default(),
            positions,
            steps: steps.into_iter().enumerate().map(step).collect(),
            trusted: trusted.iter().map(|law| (*law).to_string()).collect(),
        };
        proof.to_string()
    }

    /// Over all steps the largest radius, and the least of what is free beyond it in one of them.
    #[test]
    fn the_verdict_in_words() {
        let position = tube([1e-15, 2e-15, 3e-15], [1e-6; 3]);
        let one = tube([1e-9, 3e-8, 2e-9], [4e-6, 5e-6, 6e-6]);
        let other = tube([5e-7, 1e-8, 1e-9], [3e-6, 8e-6, 6e-6]);
        assert_eq!(
            proof_of(
                vec![Ok(one.clone()), Ok(other.clone())],
                vec![Ok(position.clone()); 3],
                &["`lift` in `cam`"]
            ),
            "crank: all 2 steps are proved. From t = 0 s to 2 s exactly one continuous motion passes through the computed positions.\n  \
             The proved motion is within 5.0e-7 m and 3.0e-8 rad of the interpolated positions. No other motion comes within 2.4e-6 m and 4.9e-6 rad of the proved motion.\n  \
             The computed positions deviate by at most 3.0e-15 m and 2.0e-15 rad.\n  This proof relies on the bounds of `lift` in `cam`."
        );
        let single = proof_of(vec![Ok(one.clone())], vec![], &[]);
        assert!(
            single.starts_with("crank: the step is proved. From t = 0 s to 1 s")
                && !single.contains("Computed")
                && !single.contains("trust")
        );
        let failed = proof_of(
            vec![
                Ok(one),
                Err(doubt(1.5, UnprovedReason::Singular { coordinate: "x".to_string() })),
            ],
            vec![Ok(position.clone()); 3],
            &[],
        );
        assert!(
            failed.starts_with("crank: Kin proved 1 of 2 steps.\n  The proved motion is within"),
            "{failed}"
        );
        assert!(
            failed.ends_with(
                "The first step without proof is step 2, from t = 1 s to 2 s. Near t = 1.5 s the pose may be singular, and `x` can move most easily at this pose."
            ),
            "{failed}"
        );
        let alone = proof_of(
            vec![],
            vec![
                Ok(position),
                Err(doubt(0.0, UnprovedReason::Apart { equation: "rod".to_string(), by: 0.1 })),
            ],
            &[],
        );
        assert!(
            alone.starts_with(
                "crank: Kin proved 1 of 2 positions.\n  The computed positions deviate by at most 3.0e-15 m"
            ),
            "{alone}"
        );
        assert!(
            alone.contains(
                "\n  Near t = 0 s the interpolated positions violate `rod` by 1.0e-1 (in the unit"
            ) && !alone.contains("The proved motion is within"),
            "{alone}"
        );
    }

    #[test]
    fn an_equation_without_bounds_in_words() {
        let unbounded = |expression: Option<&str>, source| {
            let expression = expression.map(str::to_string);
            doubt(
                0.5,
                UnprovedReason::Unbounded { equation: "cam".to_string(), expression, source },
            )
            .to_string()
        };
        assert_eq!(unbounded(None, None), "Near t = 0.5 s Kin knows no bounds of `cam`.");
        let source = Source { file: "cam.rs", line: 3, column: 5 };
        assert_eq!(
            unbounded(Some("x.floor()"), Some(source)),
            format!(
                "Near t = 0.5 s Kin knows no bounds of `cam`: `x.floor()` jumps near this time, or has no value or slope ({source})."
            )
        );
    }

    /// A bound that suffices is printed rounded up, one that is proved to be free rounded down.
    #[test]
    fn numbers_are_rounded_outwards() {
        let mut x = 1.2345e-14;
        while x < 1e3 {
            let [high, low] = [above(x), below(x)].map(|text| text.parse::<f64>().unwrap());
            assert!(low <= x && x <= high && high <= 1.1001 * low, "{x:e}: {low:e} {high:e}");
            x *= 1.0371;
        }
        assert_eq!(
            [above(1.04e-13), below(9.96e-5), above(9.94e-5), above(2.0), below(0.0)],
            ["1.1e-13", "9.9e-5", "1.0e-4", "2.0e0", "0.0e0"]
        );
    }
}
