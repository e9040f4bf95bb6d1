//! Every constraint of these tests, read from the text that it keeps: all terms are those that were
//! compiled.

use kin::Constraint;
use kin::data::Describer;
use kin::prelude::*;
use kin_text::Equation;

use crate::as_text::{difference, like};
use crate::{branches, effects, generics, own, promises, refused};

/// Constraints whose text does not stand alone, by what it speaks of: types of parameters that no
/// file can hold, types and functions beside the constraint that are not marked as its helpers,
/// bodies that only rustc can follow.
const PROGRAMS: [(&str, &[&str]); 4] = [
    (
        "` of `",
        &[
            "bounded::flat_profile",
            "bounded::gentle_profile",
            "bounded::options_empty",
            "bounded::options_held",
            "bounded::options_small",
            "bounded::round_profile",
            "bounded::steep_profile",
            "bounded::structs_taken_apart",
            "bounded::whole_numbers_cast",
            "control::a_parameter_as_index",
            "control::if_as_a_statement",
            "control::match_on_a_tuple",
            "control::match_on_an_enum_of_ones_own",
            "control::match_on_the_other_variant",
            "corpus::chains::distances_to_anchors",
            "corpus::complex::roots_of_unity",
            "corpus::contact::chain_over_two_sprockets",
            "corpus::contact::over_pins",
            "corpus::contact::pin_in_a_geneva_slot",
            "corpus::contact::point_on_an_involute",
            "corpus::contact::worm_flank",
            "corpus::curves::epicycloid",
            "corpus::drives::winch_in_layers",
            "corpus::flow::bits_of_a_mask",
            "corpus::flow::bound_by_at",
            "corpus::idioms::words_as_modes",
            "corpus::iterators::moving_average",
            "corpus::machines::bellcrank",
            "corpus::machines::block_and_tackle",
            "corpus::machines::planetary_gear",
            "corpus::machines::scotch_yoke",
            "corpus::robots::cable_driven",
            "corpus::robots::denavit_hartenberg_by_matrices",
            "corpus::splines::catmull_rom",
            "corpus::splines::chebyshev_by_clenshaw",
            "corpus::surfaces::metaballs",
            "corpus::surfaces::soft_maximum_by_p_norm",
            "corpus::types::motor_at_a_constant_speed",
            "corpus::types::motor_on_a_ramp",
            "corpus::types::motor_that_is_off",
            "corpus::types::parameter_with_methods",
            "corpus::unread::gear_train",
            "effects::effects_in_a_chain_that_is_not_begun",
            "effects::effects_in_a_chain_to_its_end",
            "effects::effects_in_a_chain_up_to_the_first_that_fails",
            "generics::types_with_lifetimes_and_types_of_their_own",
            "generics::what_lives_as_long_as_the_program",
            "own::a_constraint_in_a_module",
            "own::a_sum_of_parameters_is_one_number",
            "own::an_optional_parameter_in_both_cases",
            "own::fields_and_methods_of_a_parameter",
            "refused::own_link",
            "refused::tables_of_pairs",
            "refused::through_a_table",
            "refused::vectors_from_fields",
            "refused::vectors_from_fields_in_a_dual_body",
        ],
    ),
    (
        "the type `",
        &[
            "corpus::complex::complex_polynomial",
            "corpus::complex::joukowski",
            "corpus::complex::quotients_of_complex_numbers",
            "corpus::complex::six_bar_by_complex_numbers",
            "corpus::complex::spherical_four_bar_by_dual_angles",
            "corpus::rotations::quaternion_of_the_module",
            "corpus::types::stationary_point_by_jets",
            "refused::complex_loop",
        ],
    ),
    (
        "`#[helper]` before it",
        &[
            "branches::with_a_call_in_one_branch",
            "own::a_generic_function_of_a_constant",
            "own::a_leaf_of_coordinate_time_and_parameter",
            "own::a_leaf_of_vectors",
            "own::generic_functions_of_ones_own",
            "refused::complex_by_constructor",
            "refused::of_a_state",
            "refused::real_from_integers",
        ],
    ),
    (
        "the dual route",
        &[
            "control::a_loop_bound_by_a_parameter_is_dual",
            "control::a_loop_with_break_is_dual",
            "control::dual_numbers_when_asked_for",
            "corpus::machines::wrapped_angle",
            "effects::below_zero",
            "effects::thirteen",
            "own::an_axis_and_a_slope_by_dual_numbers",
            "own::iterators_over_a_list_are_dual",
            "promises::searched",
            "values::a_coordinate_called_t_is_not_time",
        ],
    ),
];

/// Reads the text of a constraint, and compares all terms with the compiled ones: at states of
/// order 1, near zeros, at zero and with single zeros.
pub fn agrees(path: &str, compiled: &dyn Constraint) {
    let name = path.trim_start_matches("language::");
    let mut describer = Describer::default();
    compiled.describe(&mut describer);
    let listed =
        PROGRAMS.iter().find(|(_, names)| names.contains(&name)).map(|(reason, _)| *reason);
    let (text, reason) = match (describer.equation(), listed) {
        (Some(text), None) => (text, ""),
        (None, Some(reason)) => (String::new(), reason),
        (text, _) => panic!("{name}: the text {text:?} lacks {:?}", describer.lacking()),
    };
    if text.is_empty() {
        let lacking = describer.lacking().join(", ");
        assert!(lacking.contains(reason), "{name} lacks {lacking}");
        return;
    }
    let equation =
        Equation::read(&text).unwrap_or_else(|mistakes| panic!("{name}: {mistakes}\n{text}"));
    let read = like(&equation, compiled);
    let n = compiled.arguments().iter().map(|argument| argument.target.columns()).sum();
    let random = &mut fastrand::Rng::with_seed(19);
    for state in 0..24 {
        let near = [2.0, 1e-8, 0.0, 2.0][state % 4];
        let mut vector =
            |near: f64| -> Vec<f64> { (0..n).map(|_| near * (2.0 * random.f64() - 1.0)).collect() };
        let [mut q, qd, qdd] = [vector(near), vector(2.0), vector(2.0)];
        if state % 4 == 3 {
            q[state / 4 % n] = 0.0;
        }
        let found = difference(compiled, &read, [&q, &qd, &qdd], 0.37);
        assert!(found < 1e-14, "{name}: {found:e} at {q:?}");
    }
}

#[test]
fn constraints_that_are_tested_by_themselves_agree_too() {
    let c = kin::check::any_coord;
    let p = kin::check::any_planar;
    agrees("branches::with_a_call_in_one_branch", &branches::with_a_call_in_one_branch(c(), c()));
    agrees("effects::thirteen", &effects::thirteen(c()));
    agrees("effects::below_zero", &effects::below_zero(c(), [1.0; 3]));
    agrees("generics::legs", &generics::legs([c(), c(), c()], [1.0, 2.0, 3.0]));
    agrees("generics::mean_of", &generics::mean_of([c(), c(), c(), c()], [1.0, 2.0, 3.0, 4.0]));
    agrees("own::generic_inside", &own::generic_inside(c(), 2.0));
    agrees("promises::geared", &promises::geared(c(), c(), 3.0));
    agrees("promises::stepped", &promises::stepped(c()));
    agrees("promises::wrapped", &promises::wrapped(c()));
    agrees("promises::growing", &promises::growing(c()));
    agrees("promises::searched", &promises::searched(c()));
    agrees("promises::timed_pair", &promises::timed_pair(p(), Law::harmonic(0.3, 2.0), 1.7, 0.1));
    agrees("promises::hold_x", &promises::hold_x(p(), 0.2));
    agrees("refused::types_of_a_macro", &refused::types_of_a_macro(c(), 2.0, [3.0, 4.0]));
    let link = refused::belt::Link { pitch: 0.5, roller: 0.1 };
    agrees("refused::own_link", &refused::belt::own_link(c(), link));
    agrees(
        "refused::through_a_table",
        &refused::through_a_table(c(), vec![(0.0, 2.0), (1.0, 5.0)]),
    );
    agrees("refused::of_a_state", &refused::of_a_state(p(), p(), 2.0));
    agrees("refused::real_from_integers", &refused::real_from_integers(c()));
}

/// `twice!` and `reads!` read the text of each constraint; all others are named in this file.
#[test]
fn no_constraint_of_these_tests_is_left_out() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/language");
    let mut all = String::new();
    let mut left = Vec::new();
    for entry in std::fs::read_dir(&folder)
        .expect("a folder")
        .chain(std::fs::read_dir(folder.join("corpus")).expect("a folder"))
    {
        let path = entry.expect("an entry").path();
        if path.extension().is_none_or(|extension| extension != "rs")
            || path.ends_with("text.rs")
            || path.ends_with("twice.rs")
        {
            continue;
        }
        let text = std::fs::read_to_string(&path).expect("readable");
        let module = path.file_stem().expect("a name").to_string_lossy().into_owned();
        let read: String =
            text.split("reads!(").skip(1).filter_map(|rest| rest.split("=> [").next()).collect();
        let marked = text
            .split("#[constraint")
            .skip(1)
            .filter_map(|rest| rest.split("fn ").nth(1)?.split(['(', '<']).next());
        for name in marked {
            let is_named = include_str!("text.rs").contains(&format!("\"{module}::{name}\""));
            // The name that a macro gives.
            let is_named = is_named || name == "$name";
            if !is_named && !read.contains(&format!("{name}(")) {
                left.push(format!("{module}::{name}"));
            }
        }
        all += &text;
    }
    assert!(left.is_empty(), "{left:?}");
    // Nothing is listed that is not there any more.
    for name in PROGRAMS.iter().flat_map(|(_, names)| names.iter()) {
        let last = name.rsplit("::").next().unwrap_or_default();
        assert!(all.contains(last), "there is no `{name}`");
    }
}
