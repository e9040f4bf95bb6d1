//! Laws without bounds, which are sampled.

use super::*;

/// By how much samples are off their polynomial between two times, from an instant or from none,
/// and whether that hides anything.
fn off_by(system: &System, ends: [f64; 2], instant: Option<Instant>) -> (f64, bool) {
    let mut drive = Drive::new(system.equations());
    let mut lever = Known::new(system);
    lever.instant = instant.unwrap_or(lever.instant);
    let hidden = hides(&mut drive, system, ends, &mut lever);
    assert!(
        drive.sources[0].is_sampled
            && !drive.ends_suffice
            && drive.steps == 0
            && drive.longest == 2.0 * (ends[1] - ends[0]).abs()
    );
    (drive.off.0[0], hidden)
}

fn cubic(t: f64) -> [f64; 4] {
    [t * t * t, 3.0 * t * t, 6.0 * t, 6.0]
}

fn close((found, hidden): (f64, bool), exact: f64, expected: bool) {
    assert!(
        (found - exact).abs() < 1e-12 * (1.0 + exact) && hidden == expected,
        "{found} {exact} {hidden}"
    );
}

/// Without bounds a law is sampled over each step: how far it is off its polynomials from both
/// ends, and how far it leaves what is between these.
#[test]
fn laws_that_are_sampled() {
    let of =
        |f: fn(f64) -> [f64; 4], ends: [f64; 2]| off_by(&driven(Law::new(Silent(f))), ends, None);
    close(of(cubic, [0.0, 0.3]), 0.027, false);
    close(of(cubic, [0.3, 0.0]), 0.027, false);
    close(of(cubic, [0.0, 0.5]), 0.125, true);
    close(of(|t| [-t * t * t, -3.0 * t * t, -6.0 * t, -6.0], [0.0, 0.3]), 0.027, false);
    close(of(cubic, [1.0, 1.3]), 0.027, false);
    let hill = |t: f64| [t * (1.0 - t), 1.0 - 2.0 * t, -2.0, 0.0];
    close(of(hill, [0.0, 1.0]), 0.25, true);
    close(of(|t| [t * (t - 1.0), 2.0 * t - 1.0, 2.0, 0.0], [0.0, 1.0]), 0.25, true);
    close(of(hill, [0.0, 0.5]), 0.0, false);
    // Below its polynomials from both ends; and what goes up or down evenly is between its ends.
    close(
        of(
            |t| {
                [
                    (t - 0.5).powi(4),
                    4.0 * (t - 0.5).powi(3),
                    12.0 * (t - 0.5).powi(2),
                    24.0 * (t - 0.5),
                ]
            },
            [0.0, 1.0],
        ),
        1.0,
        true,
    );
    let hollow = |t: f64| {
        [-(t - 0.5).powi(4), -4.0 * (t - 0.5).powi(3), -12.0 * (t - 0.5).powi(2), -24.0 * (t - 0.5)]
    };
    close(of(hollow, [0.0, 1.0]), 1.0, true);
    close(of(|t| [3.0 * t, 3.0, 0.0, 0.0], [0.0, 1.0]), 0.0, false);
    close(of(|t| [1.0 - 3.0 * t, -3.0, 0.0, 0.0], [0.0, 1.0]), 0.0, false);
    let spike = |t: f64| if (t - 0.125).abs() < 0.01 { [1.0, 0.0, 0.0, 0.0] } else { [0.0; 4] };
    close(of(spike, [0.0, 1.0]), 1.0, true);
    close(of(spike, [1.0, 0.0]), 1.0, true);
    let hole = |t: f64| if t == 0.5 { [f64::NAN; 4] } else { [0.0; 4] };
    assert_eq!(of(hole, [0.0, 1.0]), (f64::INFINITY, true));
}

#[test]
fn laws_that_are_sampled_at_the_position_in_hand() {
    // The position in hand counts, whatever it was before.
    let system = stretching(Law::new(Silent(cubic)));
    let at = |x: f64| Some(system.equations().instant_at(0.0, &[x]));
    close(off_by(&system, [0.0, 0.1], at(1.0)), 1e-3, false);
    close(off_by(&system, [0.0, 0.1], at(5.0)), 5e-3, false);
    let mut drive = Drive::new(system.equations());
    let mut lever = Known::new(&system);
    for x in [1.0, 5.0] {
        lever.instant = system.equations().instant_at(0.0, &[x]);
        assert!(!hides(&mut drive, &system, [0.0, 0.1], &mut lever));
        assert!((drive.off.0[0] - 1e-3 * x).abs() < 1e-12);
    }
}
