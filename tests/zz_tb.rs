#[test]
fn tb() { let t = trybuild::TestCases::new(); t.compile_fail("tests/ui/law_used_as_a_number.rs"); }
