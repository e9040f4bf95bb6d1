//! The promises of the language, item by item: a test in this folder shows that each works, and a
//! program of `tests/ui` that its nearest mistake has a message at the token.

use std::path::Path;

/// An item, tests that it is read, and programs with its nearest mistakes.
type Item = (&'static str, &'static [&'static str], &'static [&'static str]);

/// Items that hang on types.
const TYPES: [Item; 13] = [
    (
        "types that a macro hands over",
        &["types_that_a_macro_hands_over"],
        &["type_that_a_macro_hands_over_is_unknown"],
    ),
    ("a struct named Link", &["a_struct_of_the_users_may_be_called_link"], &["link_as_argument"]),
    (
        "helpers of slices and arrays of pairs",
        &["tables_of_pairs", "a_helper_of_a_table_and_a_coordinate"],
        &["helper_called_with_a_table_of_triples"],
    ),
    (
        "generic structs, literals, methods",
        &["complex_loop", "complex_by_constructor", "a_struct_of_parameters", "a_struct_inside"],
        &["field_that_a_struct_has_not", "method_that_a_struct_has_not", "plain_array_in_a_struct"],
    ),
    ("inner const generics", &["const_generics_inside"], &["inner_length_that_is_another"]),
    ("inner integers", &["integers_inside"], &["inner_integer_given_a_number"]),
    ("inner bounds", &["bounds_inside"], &["inner_generic_called_with_too_many_arguments"]),
    ("nalgebra's vectors and back", &["through_nalgebra"], &["nalgebra_vector_of_too_few_numbers"]),
    (
        "vectors from fields",
        &["vectors_from_fields", "vectors_from_fields_in_a_dual_body"],
        &["vector_from_a_field_of_three_numbers", "vector_of_too_few_numbers"],
    ),
    (
        "options as values of branches",
        &["optional_branches"],
        &["option_used_as_a_number", "branches_of_different_types"],
    ),
    ("declared, assigned later", &["assigned_later"], &["read_before_it_is_assigned"]),
    (
        "states by paths and handed to helpers",
        &["methods_by_their_paths", "a_state_handed_to_a_helper"],
        &[
            "method_of_a_state_by_its_path_without_an_argument",
            "state_of_the_other_family_handed_to_a_helper",
        ],
    ),
    (
        "integers into numbers, a total order",
        &["a_real_is_made_of_integers_and_has_an_order"],
        &["real_of_a_wider_integer"],
    ),
];

/// Items that are symbolic because every bound is known.
const BOUNDED: [Item; 19] = [
    ("assertions", &["assertions"], &["assertion_of_a_number"]),
    (
        "parameters taken apart",
        &["flat_profile", "round_profile", "options_held", "structs_taken_apart"],
        &[
            "unknown_variant_in_a_pattern",
            "part_of_an_option_that_is_a_vector",
            "tuple_taken_apart_wrongly",
        ],
    ),
    ("map_or", &["options_empty"], &["map_or_without_its_function"]),
    ("then", &["options_small"], &["then_of_a_number"]),
    (
        "tables inside",
        &["tables_inside"],
        &["constant_table_read_beyond_its_end", "table_of_too_many_numbers"],
    ),
    (
        "early returns",
        &["returns_anywhere"],
        &["early_return_of_another_kind", "nested_return_of_another_kind"],
    ),
    ("let else", &["let_else_and_chains"], &["let_else_that_goes_on"]),
    (
        "break, continue, labels",
        &["breaks_and_labels"],
        &["break_of_another_kind", "unknown_label"],
    ),
    (
        "while and loop with known bounds",
        &["newton_with_an_end"],
        &["while_bounded_by_a_number", "symbolic_asked_of_a_loop_of_unknown_length"],
    ),
    ("swap", &["lists_that_change"], &["swap_out_of_range"]),
    ("reverse", &["lists_that_change"], &["reverse_of_a_number"]),
    ("first", &["lists_that_change"], &["first_used_as_a_number"]),
    ("reduce", &["lists_that_change"], &["reduce_by_a_closure_of_one"]),
    ("min_by", &["lists_that_change"], &["min_by_without_an_order"]),
    ("scan", &["lists_that_change"], &["scan_without_a_beginning"]),
    ("iter_mut", &["lists_that_change"], &["iter_mut_of_what_is_not_mut"]),
    ("try_into", &["lists_that_change"], &["try_into_another_length"]),
    (
        "closures over slices, that change, that are chosen",
        &["closures_of_every_kind"],
        &[
            "closure_called_with_too_many_arguments",
            "closure_that_changes_what_is_not_mut",
            "closure_chosen_and_called_with_too_much",
        ],
    ),
    (
        "casts and complements of integers",
        &["whole_numbers_cast"],
        &["cast_of_a_vector", "not_of_a_number", "symbolic_asked_of_integers_that_overflow"],
    ),
];

/// Signatures that are generic.
const GENERIC: [Item; 4] = [
    (
        "lengths",
        &["lengths_of_the_attribute"],
        &["const_generic_without_a_length", "length_by_an_unknown_name", "length_that_is_another"],
    ),
    (
        "arrays of bodies",
        &["planar_bodies_in_an_array", "spatial_bodies_in_an_array"],
        &["array_of_no_bodies", "bodies_of_too_many_coordinates"],
    ),
    (
        "what lives as long as the program",
        &["what_lives_as_long_as_the_program"],
        &["static_parameter_of_a_coordinate", "borrowed_slice"],
    ),
    (
        "types of a lifetime or a type's own, as far as a constraint can keep them",
        &["types_with_lifetimes_and_types_of_their_own"],
        &["lifetime", "lifetime_of_a_parameter", "generic_function"],
    ),
];

#[test]
fn every_item_works_and_its_nearest_mistake_is_told() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests");
    let files = std::fs::read_dir(root.join("language")).expect("readable");
    let paths =
        files.map(|file| file.expect("a file").path()).filter(|path| !path.ends_with("items.rs"));
    let text: String = paths.filter_map(|path| std::fs::read_to_string(path).ok()).collect();
    let is_test = |name: &str| {
        let behind = |begin: &str| text.contains(&format!("{begin}{name}("));
        let in_a_list = text.contains(&format!("    {name} "));
        behind("fn ") || behind("Symbolic ") || in_a_list
    };
    for (item, works, mistakes) in TYPES.iter().chain(&BOUNDED).chain(&GENERIC) {
        for name in *works {
            assert!(is_test(name), "{item}: no test `{name}`");
        }
        for name in *mistakes {
            let message = std::fs::read_to_string(root.join(format!("ui/{name}.message")))
                .unwrap_or_default();
            // Line, column and the token, then what is said.
            assert!(message.contains("`: "), "{item}: no message of `{name}`");
        }
        assert!(!works.is_empty() && !mistakes.is_empty(), "{item}");
    }
}
