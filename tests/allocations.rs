//! A step of time allocates nothing: counted with an allocator that counts.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use kin::prelude::*;
use kin::solver::Stop;
use kin::{Engine, Mechanism, SolverOptions, linspace};

struct Counting;

thread_local! {
    /// Of this thread alone: the test harness allocates on others.
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
}

// SAFETY: every call goes to the system's allocator as it comes.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.set(ALLOCATIONS.get() + 1);
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static COUNTING: Counting = Counting;

fn allocations(system: &kin::System, steps: usize, options: &SolverOptions) -> usize {
    let times = linspace(0.0, 1e-3 * (steps - 1) as f64, steps);
    let before = ALLOCATIONS.get();
    let motion = system.solver().options(options.clone()).run(&times).unwrap();
    assert_eq!(motion.len(), steps);
    ALLOCATIONS.get() - before
}

#[test]
fn number_of_steps_does_not_change_the_number_of_allocations() {
    let mut m = Mechanism::new("four-bar");
    let crank = m.link_between("crank", vec2(0.0, 0.0), vec2(1.0, 0.0)).unwrap();
    let coupler = m.link_between("coupler", vec2(1.0, 0.0), vec2(3.0, 2.87)).unwrap();
    let rocker = m.link_between("rocker", vec2(4.0, 0.0), vec2(3.0, 2.87)).unwrap();
    let ground = m.ground();
    m.add("O", revolute(ground, crank, vec2(0.0, 0.0), crank.start())).unwrap();
    m.add("A", revolute(crank, coupler, crank.end(), coupler.start())).unwrap();
    m.add("B", revolute(coupler, rocker, coupler.end(), rocker.end())).unwrap();
    m.add("C", revolute(ground, rocker, vec2(4.0, 0.0), rocker.start())).unwrap();
    m.add("motor", drive_angle(crank, Law::ramp(TAU))).unwrap();
    let system = m.build().unwrap();
    let plain = SolverOptions::new().engine(Engine::StepByStep);
    let protocol = plain.clone().stop(Stop::ResidualOnly(1e-10)).predict(false);
    for options in [plain, protocol] {
        allocations(&system, 2, &options);
        assert_eq!(allocations(&system, 20, &options), allocations(&system, 2000, &options));
    }
    steps_of_a_program_allocate_nothing(&system);
}

/// Small moves of a follower, also where it turns back.
#[test]
fn small_moves_of_a_follower_allocate_nothing() {
    let mut m = Mechanism::new("four-bar");
    let crank = m.link("crank", 1.0).unwrap();
    let coupler = m.link("coupler", 3.5).unwrap();
    let rocker = m.link("rocker", 3.0).unwrap();
    m.add("O", revolute(Ground, crank, vec2(0.0, 0.0), crank.start())).unwrap();
    m.add("A", revolute(crank, coupler, crank.end(), coupler.start())).unwrap();
    m.add("B", revolute(coupler, rocker, coupler.end(), rocker.end())).unwrap();
    m.add("C", revolute(Ground, rocker, vec2(4.0, 0.0), rocker.start())).unwrap();
    m.add("motor", drive_angle(crank, Law::constant(0.0))).unwrap();
    m.prefer(rocker, 1.75);
    let mut follower = m.build().unwrap().follower(0.0).unwrap();
    let mut moved = |from: usize, to: usize| {
        let before = ALLOCATIONS.get();
        for k in from..to {
            let angle = 0.01 * k as f64 + if k % 7 == 0 { -0.013 } else { 0.0 };
            follower.to([("motor", angle)]).unwrap();
        }
        ALLOCATIONS.get() - before
    };
    moved(0, 30);
    assert_eq!(moved(30, 900), 0);
}

/// By a program that is there already.
fn steps_of_a_program_allocate_nothing(system: &kin::System) {
    system.compile().unwrap();
    let compiled = SolverOptions::new().engine(Engine::Compiled);
    allocations(system, 100, &compiled);
    let counts = [100, 4000].map(|steps| allocations(system, steps, &compiled));
    assert_eq!(counts[0], counts[1], "{}", system.name());
}

/// The two-link manipulator and the platform of the gallery, and a chain of drivers.
#[test]
fn nor_do_those_of_programs_of_manipulators_platforms_and_chains() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/examples");
    for name in ["02_two_link_manipulator", "13_stewart_platform"] {
        let mechanism =
            Mechanism::read_json(format!("{folder}/{name}.json"), &kin::data::Registry::new())
                .unwrap();
        steps_of_a_program_allocate_nothing(&mechanism.build().unwrap());
    }
    let mut m = Mechanism::new("chain");
    let mut last: Option<kin::Link> = None;
    for k in 0..30 {
        let link = m.link(&format!("link {k}"), 1.0).unwrap();
        match last {
            None => m.add("pin 0", revolute(Ground, link, vec2(0.0, 0.0), link.start())).unwrap(),
            Some(last) => {
                m.add(&format!("pin {k}"), revolute(last, link, last.end(), link.start())).unwrap()
            }
        };
        m.add(&format!("motor {k}"), drive_angle(link, Law::sine(0.3, 1.0, 0.1 * k as f64)))
            .unwrap();
        last = Some(link);
    }
    steps_of_a_program_allocate_nothing(&m.build().unwrap());
}

/// A bar on three rods of one length, one of which is superfluous: more times are no more work but
/// for the tape, which allocates nothing, and what solves time by time allocates for each time and
/// each parameter.
#[test]
fn nor_do_times_of_the_gradient_of_a_redundant_mechanism() {
    let mut m = Mechanism::new("three equal rods");
    let length = m.dimension("length", 0.2).unwrap();
    let places = ["first", "second", "third"]
        .map(|name| m.dimension(name, name.len() as f64 - 5.0).unwrap());
    let bar = m.planar("bar", pose(0.12, 0.16, 0.0)).unwrap();
    for (k, place) in places.into_iter().enumerate() {
        let ends = ((place, 0.1 * k as f64), (place, 0.1 * k as f64));
        m.add(&format!("rod {k}"), distance(bar, Ground, ends.0, ends.1, length)).unwrap();
    }
    m.add("drive", drive(bar.x(), Law::linear(0.12, 0.1))).unwrap();
    let system = m.build().unwrap();
    let counts = [100, 4000].map(|steps| {
        let motion = system.run(linspace(0.0, 0.7, steps)).unwrap();
        let names = ["length", "second", "third", "drive.law.rate"];
        let before = ALLOCATIONS.get();
        system.gradient(&motion, names, "bar.R_y", |_| [1.0, 0.5, 0.25]).unwrap();
        ALLOCATIONS.get() - before
    });
    assert!(counts[1] < counts[0] + 100, "{counts:?}");
}
