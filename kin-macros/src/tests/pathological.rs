//! Bodies that nobody should write: the macro reads them or refuses them, without running away.

use std::time::{Duration, Instant};

use proc_macro2::TokenStream;

use crate::expand;

/// Far more than any of these takes, in a debug build on a slow machine.
const LONGEST: Duration = Duration::from_secs(20);

/// The expansion of one constraint on a coordinate `x` and a number `k`.
fn expanded(body: &str) -> String {
    expanded_with("x: Coord, k: f64, n: usize", body)
}

fn expanded_with(inputs: &str, body: &str) -> String {
    let item = format!("fn f({inputs}) -> f64 {{ {body} }}");
    let item: TokenStream = item.parse().unwrap_or_else(|error| panic!("{error}: {body}"));
    let start = Instant::now();
    let expansion = expand::constraint(TokenStream::new(), item).to_string();
    assert!(start.elapsed() < LONGEST, "{:?} for {}", start.elapsed(), &body[..body.len().min(80)]);
    expansion
}

/// The message, if it is refused.
fn message(expansion: &str) -> Option<String> {
    let rest = expansion.split_once("compile_error ! {")?.1;
    Some(rest.split('"').nth(1)?.to_owned())
}

fn is_symbolic(expansion: &str) -> bool {
    message(expansion).is_none()
        && expansion.contains("reason : :: kin :: extend :: RouteReason :: Read")
}

fn is_dual(expansion: &str) -> bool {
    message(expansion).is_none()
        && expansion.contains("reason : :: kin :: extend :: RouteReason :: Unread")
}

/// Bodies of growing depth and length: how often something is repeated in each.
fn deep_and_long(n: usize) -> Vec<String> {
    let levels = n / 10;
    vec![
        format!("{}x{}", "(".repeat(levels), ")".repeat(levels)),
        format!("{}x{}", "{ ".repeat(levels), " }".repeat(levels)),
        format!("{}x{}", "f64::sin(".repeat(levels / 2), ")".repeat(levels / 2)),
        format!("{}x{}", "if x > k { ".repeat(levels / 2), " } else { k * x }".repeat(levels / 2)),
        format!("x{}", ".sin()".repeat(n)),
        format!("{}x", "-".repeat(n)),
        vec!["x"; n].join(" + "),
        vec!["(k - x)"; n].join(" * "),
        format!(
            "if x > 0.0 {{ x }} {} else {{ k * x }}",
            "else if x > k { x * 2.0 }".repeat(n / 2)
        ),
    ]
}

#[test]
fn deep_and_long_expressions_are_read() {
    for body in deep_and_long(550) {
        let expansion = on_rustcs_stack(body.clone());
        assert!(
            is_symbolic(&expansion) || is_dual(&expansion),
            "{:?} for {}",
            message(&expansion),
            &body[..40]
        );
    }
}

#[test]
fn far_too_deep_and_long_ones_are_refused() {
    for n in [2_000, 20_000] {
        for body in deep_and_long(n) {
            let message = message(&on_rustcs_stack(body.clone()));
            assert!(
                message
                    .is_some_and(|text| text.contains("name parts of the expression with `let`")),
                "{}",
                &body[..40]
            );
        }
    }
}

#[test]
fn many_steps_are_read() {
    let steps = format!("let y = x; {} y", "let y = y * k + x;".repeat(2000));
    let arms = format!(
        "match n {{ {} _ => x }}",
        (0..400).map(|i| format!("{i} => {i}.5 * x, ")).collect::<String>()
    );
    let table =
        format!("let c = [{}]; c[1] * x", "[0.5, -1.5], ".repeat(2000)).replace("c[1]", "c[1][0]");
    for body in [steps, arms, table] {
        let expansion = on_rustcs_stack(body.clone());
        assert!(
            is_symbolic(&expansion) || is_dual(&expansion),
            "{:?} for {}",
            message(&expansion),
            &body[..40]
        );
    }
}

/// The expansion on a stack like that of rustc, of which some is taken: tests have less.
fn on_rustcs_stack(body: String) -> String {
    let thread = std::thread::Builder::new().stack_size(6 << 20).spawn(move || expanded(&body));
    thread
        .unwrap_or_else(|error| panic!("{error}"))
        .join()
        .unwrap_or_else(|_| panic!("the macro panics"))
}

#[test]
fn long_loops_are_left_to_dual_numbers() {
    for range in [
        "0..1000000",
        "0..=9223372036854775807",
        "-9223372036854775808..9223372036854775807",
        "0..n",
    ] {
        assert!(
            is_dual(&expanded(&format!("let mut s = x; for _ in {range} {{ s += k; }} s"))),
            "{range}"
        );
    }
    let nested =
        "let mut s = x; for a in 0..4000 { for b in 0..4000 { for c in 0..4000 { s += k; } } } s";
    assert!(is_dual(&expanded(nested)));
    let growing = "let mut s = x; for _ in 0..4000 { s = s.sin() * s.cos() + s; } s";
    let expansion = expanded(growing);
    assert!(is_symbolic(&expansion) || is_dual(&expansion));
    assert!(is_symbolic(&expanded("let mut s = x; for _ in 5..0 { s += k; } s")));
    for body in
        ["let a = [x; 1000000]; a[0]", "let a = [[[[x; 4000]; 4000]; 4000]; 4000]; a[0][0][0][0]"]
    {
        let expansion = expanded(body);
        assert!(is_dual(&expansion), "{body}: {:?}", message(&expansion));
    }
}

#[test]
fn branches_do_not_double_the_work() {
    let steps = "let y = if y > k { y * x } else { y + x };".repeat(60);
    assert!(is_symbolic(&expanded(&format!("let y = x; {steps} y"))));
    let closures = (0..40).fold("let f0 = |y: f64| y.sin();".to_owned(), |all, i| {
        format!("{all} let f{} = |y: f64| f{i}(y) + f{i}(k * y);", i + 1)
    });
    let expansion = expanded(&format!("{closures} f40(x)"));
    assert!(is_symbolic(&expansion) || is_dual(&expansion));
}

/// Each sum is read twice: told apart, the paths to the bottom are more than anybody can count.
#[test]
fn shared_parts_of_linear_rows_do_not_double_the_work() {
    let sums = "let c = a + b; let a = b; let b = c;".repeat(60);
    let expansion = expanded_with(
        "x: Coord, y: Coord, t: Time",
        &format!("let a = x; let b = y - t; {sums} b"),
    );
    assert!(is_symbolic(&expansion) && expansion.contains("sides_of_time"));
}

#[test]
fn integers_overflow_into_dual_numbers_or_a_message() {
    let whole = [
        "x * (9223372036854775807 + 1) as f64",
        "x * (1 << 64) as f64",
        "x * (1 << 9223372036854775807) as f64",
        "x * (1 / 0) as f64",
        "x * (1 % 0) as f64",
        "x * (-9223372036854775808 / -1) as f64",
        "x * 340282366920938463463374607431768211456",
        "x.powi(99999999999)",
        "x.powi(-2147483648)",
        "x.powi(2147483647)",
        "[x, k][9223372036854775807]",
        "[x, k][-1]",
        "x * 2i64.pow(9000000000) as f64",
        "x * (-(-9223372036854775807 - 1)) as f64",
        "x + 1e999",
        "x * (3).abs_diff(-9223372036854775807) as f64",
    ];
    for body in whole {
        expanded(body);
    }
}

#[test]
fn division_by_a_literal_zero_is_read() {
    for body in [
        "x / 0.0",
        "0.0 / x",
        "(x / 0.0) / (k / 0.0)",
        "1.0 / (x - x) + x",
        "x % 0.0",
        "x.atan2(0.0)",
        "x * f64::NAN",
        "x.powf(0.0) + x",
    ] {
        let expansion = expanded(body);
        assert!(is_symbolic(&expansion) || message(&expansion).is_some(), "{body}");
    }
}

#[test]
fn recursion_ends() {
    let whole = [
        "fn g(y: f64) -> f64 { g(y) } g(x)",
        "fn g(y: f64) -> f64 { if y > 0.0 { g(y - 1.0) + g(y - 2.0) } else { y } } g(x)",
        "fn g(y: f64) -> f64 { h(y) } fn h(y: f64) -> f64 { g(y) } g(x)",
        "fn g(n: i32, y: f64) -> f64 { if n == 0 { y } else { g(n - 1, y.sin()) } } g(5, x)",
        "let g = |h: f64| h; let g = |h: f64| g(g(h)); g(x)",
        "let w = |f| f(f); w(w)",
        "fn f(x: f64) -> f64 { f(x) } f(x)",
    ];
    for body in whole {
        let expansion = expanded(body);
        assert!(
            is_symbolic(&expansion) || is_dual(&expansion) || message(&expansion).is_some(),
            "{body}"
        );
    }
}

#[test]
fn empty_and_odd_bodies_are_refused() {
    for body in [
        "",
        ";",
        ";;;",
        "{}",
        "()",
        "return",
        "return;",
        "{ x; }",
        "let y = x;",
        "if x > k { x }",
        "match x {}",
        "[]",
        "[x]",
        "(x,)",
        "|| x",
        "..",
        "break",
        "loop {}",
    ] {
        let expansion = expanded(body);
        assert!(message(&expansion).is_some() || is_dual(&expansion), "{body}");
    }
}

#[test]
fn signatures_and_items_may_be_anything() {
    let items = [
        "",
        ";",
        "fn",
        "fn f",
        "fn f()",
        "fn f();",
        "fn f() {}",
        "fn f(x: Coord) -> [f64; 0] { [] }",
        "fn f(x: Coord) -> [f64; 99999999999999999999] { [x] }",
        "fn f(x: [Coord; 0]) -> f64 { 0.0 }",
        "fn f(x: [Coord; 2000]) -> f64 { x[0] }",
        "fn f(x: Coord) -> (f64, ()) { (x, ()) }",
        "fn f(x: Coord) -> ((f64, [Vec2; 2]), f64) { x }",
        "fn f(x: Coord) -> ! { loop {} }",
        "fn f(x: Coord, x: Coord) -> f64 { x }",
        "fn r#fn(r#type: Coord) -> f64 { r#type }",
        "fn f(x: Coord, ..) -> f64 { x }",
        "fn f(x: dyn Fn(f64) -> f64) -> f64 { x }",
        "fn f(x: <Coord as Into>::Coord) -> f64 { x }",
        "fn f(x: Coord<f64>) -> f64 { x }",
        "fn f(_: Coord, y: Coord) -> f64 { y }",
        "const X: f64 = 1.0;",
        "mod m { fn f(x: Coord) -> f64 { x } }",
        "struct S(f64);",
        "impl S { fn f(x: Coord) -> f64 { x } }",
        "macro_rules! m { () => {} }",
        "1 + 1",
        "#![inner] fn f(x: Coord) -> f64 { x }",
        "fn f(x: Coord) -> f64 where f64: Copy { x }",
    ];
    for item in items {
        for attribute in ["", "dual", "symbolic", "symbolic, dual", "= 3", "(("] {
            let Ok(attribute) = attribute.parse::<TokenStream>() else { continue };
            let item: TokenStream = item.parse().unwrap_or_else(|error| panic!("{error}: {item}"));
            expand::constraint(attribute.clone(), item.clone());
            expand::law(&attribute, item);
        }
    }
}
