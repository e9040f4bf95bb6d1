//! Mechanism files that carry their equations.

use kin::data::MechanismData;
use kin::data::Registry;
use kin::prelude::*;
use kin_text::{Equation, registry};

use crate::engines::Engines;

const SLOT: &str = "/// Pin in a parabolic slot.
#[require(k != 0.0, \"a slot that is bent\")]
#[measure(along = j.local(i.point(u_i)).x, \"m\")]
fn parabolic_slot(i: Planar, j: Planar, u_i: Vec2, k: f64) -> f64 {
    let s = j.local(i.point(u_i));
    s.y - parabola(s.x, k)
}

fn parabola(x: f64, k: f64) -> f64 {
    k * x * x
}";

/// The same, compiled.
#[constraint]
fn compiled_slot(i: Planar, j: Planar, u_i: Vec2, k: f64) -> f64 {
    let s = j.local(i.point(u_i));
    s.y - k * s.x * s.x
}

fn marked() -> Equation {
    Equation::read(&SLOT.replace("#[require", "#[constraint]\n#[require")).unwrap()
}

fn mechanism(k: f64) -> Mechanism {
    with_slot(|slider, ground| {
        let slot = marked().on(slider).on(ground).with("u_i", [0.1, 0.0]).with("k", k);
        Box::new(slot.constraint().unwrap())
    })
    .unwrap()
}

fn with_slot(slot: impl Fn(PlanarBody, Ground) -> Box<dyn Constraint>) -> kin::Result<Mechanism> {
    let mut m = Mechanism::new("slider in a slot");
    let slider = m.planar("slider", pose(0.2, 0.1, 0.0))?;
    m.add("slot", slot(slider, m.ground()))?;
    m.add("upright", drive(slider.theta(), Law::constant(0.2)))?;
    m.add("motor", drive(slider.x(), Law::sine(0.3, 1.0, 0.0)))?;
    Ok(m)
}

#[test]
fn a_constraint_from_text_moves_as_the_compiled_one() {
    let read = mechanism(2.0).build().unwrap().run_both(linspace(0.0, 6.0, 61)).unwrap();
    let compiled =
        with_slot(|slider, ground| Box::new(compiled_slot(slider, ground, vec2(0.1, 0.0), 2.0)));
    let compiled = compiled.unwrap().build().unwrap().run_both(linspace(0.0, 6.0, 61)).unwrap();
    for k in 0..61 {
        for (a, b) in [
            (read.q(k), compiled.q(k)),
            (read.qd(k), compiled.qd(k)),
            (read.qdd(k), compiled.qdd(k)),
        ] {
            assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-13), "time {k}: {a:?} {b:?}");
        }
    }
}

#[test]
fn the_engine_compiles_it() {
    let options = kin::SolverOptions::new().engine(kin::Engine::Compiled);
    let system = mechanism(2.0).build().unwrap();
    let motion = system.solver().options(options.clone()).run(linspace(0.0, 6.0, 601)).unwrap();
    let plain = system.run_both(linspace(0.0, 6.0, 601)).unwrap();
    assert!(motion.engine().compiled > 500, "{:?}", motion.engine());
    for k in 0..601 {
        assert!(motion.q(k).iter().zip(plain.q(k)).all(|(a, b)| (a - b).abs() < 1e-12));
    }
}

#[test]
fn a_file_carries_its_equation_and_gives_the_same_motion() {
    let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("slot.json");
    mechanism(2.0).write_json(&path).unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    assert!(text.contains("\"equations\":[") && text.contains("fn parabolic_slot"), "{text}");
    let again = Mechanism::read_json(&path, &registry()).unwrap();
    let runs = [mechanism(2.0), again]
        .map(|m| m.build().unwrap().run_both(linspace(0.0, 6.0, 61)).unwrap());
    assert_eq!(runs[0].data(), runs[1].data());
}

/// Of the next constraint: with constants of its own and of the prelude, and functions that call
/// one another.
const LIFT: f64 = 0.3;

#[kin::helper]
fn bent<D: Dual>(x: Real<D>, k: f64) -> Real<D> {
    k * x * x * HALF
}

const HALF: f64 = 0.5;

#[kin::helper(with = bent)]
fn doubly_bent<D: Dual>(x: Real<D>, k: f64) -> Real<D> {
    // one half and one half
    bent(x, k) + bent(x, k)
}

/// Pin in a slot.
#[constraint(with = doubly_bent)]
#[require(k > LEAST)]
fn bent_slot(i: Planar, j: Planar, u_i: Vec2, k: f64) -> f64 {
    let s = j.local(i.point(u_i));
    s.y - doubly_bent(s.x, k) - LIFT * (s.x * TAU).sin()
}

const LEAST: f64 = 0.1;

const TABLE: [(f64, f64); 2] = [(0.5, 0.1), (0.75, -2.0)];
const LAST: usize = 1;
const LEVEL: Vec2 = Vec2 { x: 0.1, y: 0.2 };

/// With constants that are no numbers by themselves.
#[constraint]
fn tabled_slot(i: Planar, j: Planar, u_i: Vec2, k: f64) -> f64 {
    let s = j.local(i.point(u_i)) - LEVEL;
    s.y - k * TABLE[LAST].0 * s.x * s.x - TABLE[0].1
}

#[constraint]
fn bitten_slot(i: Planar, j: Planar, u_i: Vec2, k: f64) -> f64 {
    let s = j.local(i.point(u_i));
    s.y - k.to_bits() as f64 * s.x
}

fn lost<D: Dual>(x: Real<D>) -> Real<D> {
    x * x
}

#[constraint]
fn lost_slot(i: Planar, j: Planar, u_i: Vec2, k: f64) -> f64 {
    let s = j.local(i.point(u_i));
    s.y - k * lost(s.x)
}

#[constraint(dual)]
fn dual_slot(i: Planar, j: Planar, u_i: Vec2, k: f64) -> f64 {
    let s = j.local(i.point(u_i));
    s.y - k * s.x * s.x
}

/// The compiled mechanism, and the one that its file says to who has nothing but the file.
fn compiled_and_read(name: &str, m: Mechanism) -> [Mechanism; 2] {
    let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}.json"));
    m.write_json(&path).unwrap();
    let again = Mechanism::read_json(&path, &registry()).unwrap_or_else(|error| panic!("{error}"));
    [m, again]
}

fn move_alike([a, b]: [Mechanism; 2]) {
    let runs = [a, b].map(|m| m.build().unwrap().run_both(linspace(0.0, 6.0, 61)).unwrap());
    for k in 0..61 {
        let [a, b] = runs.each_ref().map(|run| [run.q(k), run.qd(k), run.qdd(k)].concat());
        assert!(a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 1e-13), "time {k}: {a:?} {b:?}");
    }
}

#[test]
fn a_compiled_constraint_keeps_its_text() {
    let plain =
        with_slot(|slider, ground| Box::new(compiled_slot(slider, ground, vec2(0.1, 0.0), 2.0)));
    let both = compiled_and_read("compiled_slot", plain.unwrap());
    let equations = both[0].data().unwrap().equations;
    assert!(
        equations.len() == 1 && equations[0].contains("    s.y - k * s.x * s.x\n}"),
        "{equations:?}"
    );
    move_alike(both);
}

#[test]
fn constants_and_helpers_go_with_the_text() {
    let bent = with_slot(|slider, ground| Box::new(bent_slot(slider, ground, vec2(0.1, 0.0), 2.0)));
    let both = compiled_and_read("bent_slot", bent.unwrap());
    let text = both[0].data().unwrap().equations.concat();
    for part in [
        "const HALF: f64 = 0.5;",
        "fn bent<",
        "fn doubly_bent",
        "const LIFT: f64 = 0.3;",
        "const LEAST",
    ] {
        assert_eq!(text.matches(part).count(), 1, "{part} in\n{text}");
    }
    move_alike(both);
}

#[test]
fn tables_vectors_and_integers_go_with_the_text() {
    let tabled =
        with_slot(|slider, ground| Box::new(tabled_slot(slider, ground, vec2(0.1, 0.0), 2.0)));
    let both = compiled_and_read("tabled_slot", tabled.unwrap());
    let text = both[0].data().unwrap().equations.concat();
    for part in [
        "const TABLE: [(f64, f64); 2] = [(0.5, 0.1), (0.75, -2.0)];",
        "const LAST: usize = 1;",
        "const LEVEL: Vec2 = Vec2 { x: 0.1, y: 0.2 };",
    ] {
        assert!(text.contains(part), "{part} in\n{text}");
    }
    move_alike(both);
}

#[test]
fn a_method_that_no_text_has_is_told_where_a_file_is_written() {
    let m = with_slot(|slider, ground| Box::new(bitten_slot(slider, ground, vec2(0.1, 0.0), 2.0)))
        .unwrap();
    let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("bitten.json");
    let error = m.write_json(path).err().map(|error| error.to_string()).unwrap_or_default();
    assert!(
        error.contains("constraint `slot`") && error.contains("the method `to_bits` of a number"),
        "{error}"
    );
}

#[test]
fn a_text_that_lacks_something_is_told_when_it_is_wanted() {
    let m = with_slot(|slider, ground| Box::new(lost_slot(slider, ground, vec2(0.1, 0.0), 2.0)))
        .unwrap();
    let data = m.data().unwrap();
    assert!(data.equations.is_empty());
    let error = Mechanism::from_data(&data, &registry()).err().map(|error| error.to_string());
    let error = error.unwrap_or_default();
    assert!(
        error.contains("`lost` (`#[helper]` before it and `#[constraint(with = lost)]`)"),
        "{error}"
    );
    assert!(Mechanism::from_data(&data, &Registry::new().with::<lost_slot>()).is_ok());
    let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("lost_slot.json");
    let error = m.write_json(&path).err().map(|error| error.to_string()).unwrap_or_default();
    for part in [
        "`slot`",
        "`lost` (`#[helper]` before it and `#[constraint(with = lost)]`)",
        "`write_json_for(",
    ] {
        assert!(error.contains(part), "{error}");
    }
    assert!(!path.exists());
}

#[test]
fn a_body_that_only_rustc_can_read_is_for_programs_that_have_it() {
    let m = with_slot(|slider, ground| Box::new(dual_slot(slider, ground, vec2(0.1, 0.0), 2.0)))
        .unwrap();
    let data = m.data().unwrap();
    assert!(Mechanism::from_data(&data, &Registry::new().with::<dual_slot>()).is_ok());
    let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("dual_slot.json");
    let error = m.write_json(&path).err().map(|error| error.to_string()).unwrap_or_default();
    assert!(error.contains("`slot`") && error.contains("the dual route"), "{error}");
    let error = Mechanism::from_data(&data, &registry()).err().map(|error| error.to_string());
    assert!(error.unwrap_or_default().contains("the dual route"));
}

#[test]
fn the_program_that_has_the_constraint_needs_no_reader() {
    let plain =
        with_slot(|slider, ground| Box::new(compiled_slot(slider, ground, vec2(0.1, 0.0), 2.0)));
    let data = plain.unwrap().data().unwrap();
    assert!(Mechanism::from_data(&data, &Registry::new().with::<compiled_slot>()).is_ok());
    let error = Mechanism::from_data(&data, &Registry::new()).err().map(|error| error.to_string());
    assert!(error.unwrap_or_default().contains("kin::text::registry()"));
}

#[test]
fn a_file_of_the_library_alone_carries_no_text() {
    let mut m = Mechanism::new("crank");
    let crank = m.link("crank", 1.0).unwrap();
    m.add("O", revolute(m.ground(), crank, vec2(0.0, 0.0), crank.start())).unwrap();
    assert!(m.data().unwrap().equations.is_empty());
}

#[test]
fn a_file_with_equations_asks_for_their_reader() {
    let data = mechanism(2.0).data().unwrap();
    let error = Mechanism::from_data(&data, &Registry::new())
        .err()
        .map(|error| error.to_string())
        .unwrap_or_default();
    assert!(error.contains("kin::text::registry()"), "{error}");
}

#[test]
fn a_mistake_in_a_file_is_told_with_its_place() {
    let mut data: MechanismData = mechanism(2.0).data().unwrap();
    data.equations[0] = data.equations[0].replace("s.y - parabola", "s.w - parabola");
    let error = Mechanism::from_data(&data, &registry())
        .err()
        .map(|error| error.to_string())
        .unwrap_or_default();
    assert!(error.contains("text:7:7") && error.contains("a Vec2 has no field `w`"), "{error}");
}

#[test]
fn two_equations_of_one_name_do_not_go_into_one_file() {
    let mut m = mechanism(2.0);
    let other = Equation::read("fn parabolic_slot(i: Planar) -> f64 { i.r.x }").unwrap();
    let body = m.planar("other", pose(0.0, 0.0, 0.0)).unwrap();
    m.add("second", other.on(body).constraint().unwrap()).unwrap();
    let error = m.data().err().map(|error| error.to_string()).unwrap_or_default();
    assert!(
        error.contains("`second`") && error.contains("there is another equation `parabolic_slot`"),
        "{error}"
    );
}

/// Everybody knows `revolute`: a file in which it means something else would be misread without a
/// word.
#[test]
fn an_equation_does_not_take_the_place_of_the_librarys() {
    let text = "fn revolute(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2) -> f64 { (i.point(u_i) - j.point(u_j)).x }";
    let error_of = |data: &MechanismData, registry: &Registry| {
        Mechanism::from_data(data, registry)
            .err()
            .map(|error| error.to_string())
            .unwrap_or_default()
    };
    let told = "the library has a `revolute` with the same arguments";
    let mut data = mechanism(2.0).data().unwrap();
    data.equations.push(text.to_string());
    let error = error_of(&data, &registry());
    assert!(error.contains(told) && error.contains("Give the equation another name"), "{error}");
    // Neither is one written, from a text or from a program, even where its text would be left out.
    let mut m = Mechanism::new("shadows");
    let arm = m.planar("arm", pose(0.2, 0.1, 0.0)).unwrap();
    let equation = Equation::read(text).unwrap();
    let own = equation.on(arm).on(m.ground()).with("u_i", [0.0, 0.0]).with("u_j", [0.0, 0.0]);
    m.add("O", own.constraint().unwrap()).unwrap();
    let error = m.data().err().map(|error| error.to_string()).unwrap_or_default();
    assert!(error.contains("`O`") && error.contains(told), "{error}");
    let mut m = Mechanism::new("shadows");
    let arm = m.planar("arm", pose(0.2, 0.1, 0.0)).unwrap();
    m.add("O", shadow::distance(arm, m.ground(), vec2(0.0, 0.0), vec2(0.0, 0.0), 1.0)).unwrap();
    let error = m.data().err().map(|error| error.to_string()).unwrap_or_default();
    assert!(error.contains("`O`: the library has a `distance` with the same arguments"), "{error}");
    // With other arguments it is another constraint, as `revolute` of planar and of spatial bodies
    // are.
    data.equations[1] = text.replace("i: Planar, j: Planar", "a: Planar, i: Planar, j: Planar");
    assert_eq!(error_of(&data, &registry()), "");
}

mod shadow {
    use kin::prelude::*;

    #[constraint(dual)]
    pub fn distance(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, length: f64) -> f64 {
        (i.point(u_i) - j.point(u_j)).norm() - length
    }
}

#[test]
fn of_two_equations_of_one_name_in_a_file_neither_is_taken() {
    let mut data = mechanism(2.0).data().unwrap();
    data.equations.push(data.equations[0].clone());
    assert!(Mechanism::from_data(&data, &registry()).is_ok());
    data.equations[1] = data.equations[1].replace("parabola(s.x, k)", "k * s.x");
    let error = Mechanism::from_data(&data, &registry()).err().map(|error| error.to_string());
    let error = error.unwrap_or_default();
    assert!(error.contains("two equations `parabolic_slot` have the same arguments"), "{error}");
}

/// The file says what it means: a program's own constraint of that name does not change it.
#[test]
fn the_equation_of_a_file_counts_before_the_programs() {
    let mut data = mechanism(2.0).data().unwrap();
    data.equations = vec![
        "fn compiled_slot(i: Planar, j: Planar, u_i: Vec2, k: f64) -> f64 { i.point(u_i).y - j.r.y - k }"
            .to_string(),
    ];
    data.constraints[0].kind = "compiled_slot".to_string();
    let height = |registry: &Registry| {
        let motion = Mechanism::from_data(&data, registry)?.build()?.run_both([0.0, 1.0])?;
        kin::Result::Ok(motion.q(1)[1] + 0.1 * 0.2_f64.sin())
    };
    assert!((height(&registry().with::<compiled_slot>()).unwrap() - 2.0).abs() < 1e-14);
    assert!((height(&Registry::new().with::<compiled_slot>()).unwrap() - 2.0).abs() > 0.1);
}

#[test]
fn demands_and_measures_of_a_text_hold() {
    let mut m = Mechanism::new("flat");
    let slider = m.planar("slider", pose(0.2, 0.1, 0.0)).unwrap();
    let flat = marked().on(slider).on(m.ground()).with("u_i", [0.1, 0.0]).with("k", 0.0);
    let error = m
        .add("slot", flat.constraint().unwrap())
        .err()
        .map(|error| error.to_string())
        .unwrap_or_default();
    assert!(error.contains("a slot that is bent (k = 0)"), "{error}");
    let system = mechanism(2.0).build().unwrap();
    let motion = system.run_both(linspace(0.0, 6.0, 61)).unwrap();
    let along = system.measure(&motion, "slot.along").unwrap();
    let x: Vec<f64> = (0..61).map(|k| motion.q(k)[0] + 0.1 * 0.2_f64.cos()).collect();
    assert!(along.value.values().iter().zip(&x).all(|(a, b)| (a - b).abs() < 1e-14));
}

#[test]
fn parameters_that_do_not_fit_are_told_by_name() {
    let mut m = Mechanism::new("wrong");
    let slider = m.planar("slider", pose(0.2, 0.1, 0.0)).unwrap();
    let slot = marked();
    let on = || slot.on(slider).on(Ground);
    let cases = [
        (slot.on(slider), "the constraint takes 2 bodies and coordinates, not 1"),
        (slot.on(slider.x()).on(Ground), "the argument `i` must be a planar body"),
        (on().with("k", 2.0), "the parameter `u_i` is missing. Give it by `.with(\"u_i\", …)`"),
        (on().with("k", 2.0).with("u_i", 1.0), "the parameter `u_i` takes 2 numbers, not 1"),
        (
            on().with("k", Law::constant(1.0)).with("u_i", [0.0, 0.0]),
            "the parameter `k` takes no law",
        ),
        (
            on().with("k", 2.0).with("u_i", [0.0, 0.0]).with("kk", 1.0),
            "the constraint has no parameter `kk`",
        ),
    ];
    for (making, wanted) in cases {
        let error = making.constraint().err().map(|error| error.to_string()).unwrap_or_default();
        assert!(error.contains("`parabolic_slot`") && error.contains(wanted), "{error}");
    }
}
