//! A mechanism that cannot be compiled is told by its name, and runs as it always did.

use kin::extend::by_dual;
use kin::prelude::*;

use crate::compiled;

fn crank() -> (Mechanism, kin::Link) {
    let mut m = Mechanism::new("crank");
    let crank = m.link("crank", 1.0).expect("a link");
    m.add("O", revolute(Ground, crank, vec2(0.0, 0.0), crank.start())).expect("adds");
    (m, crank)
}

/// The error of compiling, which is that of a run too.
fn refused(m: Mechanism) -> String {
    let system = m.build().expect("builds");
    assert!(system.run(linspace(0.0, 1.0, 11)).is_ok());
    let alone = system.compile().expect_err("refused");
    let run = system.solver().options(compiled()).run(linspace(0.0, 1.0, 11)).expect_err("refused");
    assert_eq!(alone.to_string(), run.to_string());
    alone.to_string()
}

#[test]
fn the_dual_route_is_told_by_the_name_of_its_constraint() {
    let (mut m, crank) = crank();
    m.add("motor", by_dual(drive_angle(crank, Law::ramp(2.0)))).expect("adds");
    let text = refused(m);
    assert!(
        text.contains("`motor`") && text.contains("dual numbers") && text.contains("Engine::Auto"),
        "{text}"
    );
}

#[test]
fn redundant_equations_are_told() {
    let (mut m, crank) = crank();
    m.add("motor", drive_angle(crank, Law::ramp(2.0))).expect("adds");
    m.add("again", drive_angle(crank, Law::ramp(2.0))).expect("adds");
    let text = refused(m);
    assert!(text.contains("more equations than coordinates"), "{text}");
}

/// √x by a library that rustc alone can read.
fn root<D: kin::extend::Dual>(x: kin::extend::Real<D>) -> kin::extend::Real<D> {
    x.sqrt()
}

/// √(1 + θ²) = 1.5 + t.
#[constraint]
fn by_a_function_of_its_angle(b: Planar, t: Time) -> f64 {
    root(1.0 + b.theta * b.theta) - 1.5 - t
}

#[test]
fn functions_of_coordinates_that_only_rustc_reads_are_told() {
    let (mut m, crank) = crank();
    m.add("motor", by_a_function_of_its_angle(crank)).expect("adds");
    m.prefer(crank, 1.0);
    let text = refused(m);
    assert!(text.contains("`motor`") && text.contains("only rustc can read"), "{text}");
}

#[test]
fn options_that_a_program_does_not_know_are_told() {
    let (mut m, crank) = crank();
    m.add("motor", drive_angle(crank, Law::ramp(2.0))).expect("adds");
    let system = m.build().expect("builds");
    let options = compiled().predict(false);
    let error =
        system.solver().options(options.clone()).run(linspace(0.0, 1.0, 11)).expect_err("refused");
    assert!(error.to_string().contains("Engine::Auto"), "{error}");
}
