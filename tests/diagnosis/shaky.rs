//! Structures that are rigid in second order only: one verdict by run and diagnosis, and what play
//! does to them.

use kin::SolverOptions;
use kin::diagnosis::Persistence;
use kin::error::FailureKind;
use kin::prelude::*;

use crate::models::*;

/// Bars of these lengths in line between two pins of the ground, drawn a little beside the line.
fn in_line(lengths: &[f64], off: f64) -> Mechanism {
    let mut m = Mechanism::new("bars in line");
    let (mut x, mut before): (f64, Option<Link>) = (0.0, None);
    for (k, length) in lengths.iter().enumerate() {
        let bar = m.link(&format!("bar {}", k + 1), *length).unwrap();
        let y = off * ((1.0 + k as f64) * 2.4).sin();
        m.set_pose(bar, pose(x + 0.5 * length, y, off * (4.0 - 7.0 * k as f64))).unwrap();
        match before {
            None => m.add("O", revolute(m.ground(), bar, vec2(0.0, 0.0), bar.start())).unwrap(),
            Some(before) => {
                m.add(&format!("M{k}"), revolute(before, bar, before.end(), bar.start())).unwrap()
            }
        };
        (x, before) = (x + length, Some(bar));
    }
    let last = before.unwrap();
    m.add("E", revolute(last, m.ground(), last.end(), vec2(x, 0.0))).unwrap();
    m
}

#[test]
fn one_verdict_of_a_shaky_structure() {
    for k in 0..24 {
        let off = 0.0004 * f64::from(k * k);
        let system = in_line(&[0.4, 0.3], off).build().unwrap();
        let error = system.run([0.0]).unwrap_err();
        let said = error.to_string();
        let found = system.diagnose(0.0).unwrap();
        assert!(
            !(said.clone() + &found.to_string()).contains("can be driven"),
            "{off}: {said}\n{found}"
        );
        assert_eq!((found.rank, error.diagnosis().unwrap().rank), (5, 5), "{off}: {said}\n{found}");
        assert!(found.to_string().contains("rigid but shaky: `bar 1` and `bar 2`"), "{found}");
        assert!(said.contains("rigid but shaky"), "{said}");
    }
}

/// Each of the three joints lets the bars be longer by the play ε: with h the height of the middle
/// joint, 3 ε = ½ h² (1 / 0.4 + 1 / 0.3), and the middle of each bar moves by ½ h.
#[test]
fn play_lets_a_shaky_structure_move_by_its_square_root() {
    for unit in [1.0, 1000.0] {
        let found = in_line(&[0.4 * unit, 0.3 * unit], 0.0).diagnose(0.0).unwrap();
        let play = found.freedoms[0].play.clone().unwrap_or_else(|| panic!("{found}"));
        let slack = 3.0 * play.play / unit;
        let h = (2.0 * slack / (1.0 / 0.4 + 1.0 / 0.3)).sqrt();
        assert!((play.moves / unit - 0.5 * h).abs() < 1e-4 * h, "{play:?} {h}");
        assert!((play.turns - h / 0.3).abs() < 1e-3 * h && play.body == "bar 2", "{play:?} {h}");
        assert!(found.to_string().contains("in every joint lets `bar 2` move by"), "{found}");
    }
    // The same, put together: with bars that are longer by so much the middle joint stands so high.
    let slack = 3e-5;
    let mut m = Mechanism::new("slack");
    let a = m.link("a", 0.4).unwrap();
    let b = m.link("b", 0.3).unwrap();
    m.set_pose(a, pose(0.2, 0.02, 0.1)).unwrap();
    m.set_pose(b, pose(0.55, 0.02, -0.1)).unwrap();
    m.add("O", revolute(m.ground(), a, vec2(0.0, 0.0), a.start())).unwrap();
    m.add("M", revolute(a, b, a.end(), b.start())).unwrap();
    m.add("E", revolute(b, m.ground(), b.end(), vec2(0.7 - slack, 0.0))).unwrap();
    let q = m.build().unwrap().position(0.0).unwrap().q;
    let h = (2.0 * slack / (1.0 / 0.4 + 1.0 / 0.3)).sqrt();
    assert!((q[1] - 0.5 * h).abs() < 1e-2 * h, "{q:?} {h}");
}

/// Three bars in line have two motions of first order, of which no combination goes on.
#[test]
fn several_motions_of_first_order_are_looked_at_together() {
    for lengths in [vec![0.4, 0.3, 0.5], vec![1.0, 1.0, 1.0, 1.0]] {
        let found = in_line(&lengths, 0.0).diagnose(0.0).unwrap();
        assert_eq!(found.freedoms.len(), lengths.len() - 1, "{found}");
        let stiff = |freedom: &kin::diagnosis::Freedom| {
            freedom.persistence == Persistence::Infinitesimal && freedom.play.is_some()
        };
        assert!(found.freedoms.iter().all(stiff) && found.mobility == 0, "{found}");
    }
}

/// A mechanism that moves is not shaky, with redundant equations neither: all second orders vanish.
#[test]
fn motion_of_a_redundant_mechanism_is_finite() {
    let found = parallelogram(1.0, 1.0).mechanism.diagnose(0.0).unwrap();
    assert_eq!(
        (found.mobility, found.freedoms[0].persistence),
        (1, Persistence::Always),
        "{found}"
    );
    assert!(found.freedoms[0].play.is_none(), "{found}");
}

/// Three cranks in line with their ground, one of which is off by less than is allowed.
#[test]
fn error_of_a_closure_never_says_that_it_can_be_driven() {
    for (off, closure) in [(1e-9, 1e-7), (3e-7, 1e-6), (-1e-6, 1e-5), (1e-5, 1e-4), (1e-4, 1e-3)] {
        for angle in [0.0, PI, 1e-4] {
            let mut p = parallelogram(1.0 + off, angle);
            let crank = p.cranks[0];
            p.mechanism.add("motor", drive_angle(crank, Law::linear(angle, 1.0))).unwrap();
            let system = p.mechanism.build().unwrap();
            if let Err(error) = system
                .solver()
                .options(SolverOptions::new().allowed_misfit(closure))
                .run(linspace(0.0, 4.0, 41))
            {
                let said = error.to_string();
                assert!(!said.contains("can be driven"), "{off} {angle}: {said}");
                let told = matches!(error.kind(), Some(FailureKind::CannotBeDriven));
                assert!(
                    !told || !error.diagnosis().unwrap().can_be_driven(),
                    "{off} {angle}: {said}"
                );
            }
        }
    }
}
