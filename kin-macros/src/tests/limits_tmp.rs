use proc_macro2::TokenStream;
use crate::expand;
#[test]
fn limits() {
    let n: usize = std::env::var("N").unwrap().parse().unwrap();
    let kind = std::env::var("PAT").unwrap();
    let body = match kind.as_str() {
        "paren" => format!("{}x{}", "(".repeat(n), ")".repeat(n)),
        "block" => format!("{}x{}", "{ ".repeat(n), " }".repeat(n)),
        "fun" => format!("{}x{}", "f64::sin(".repeat(n), ")".repeat(n)),
        "method" => format!("x{}", ".sin()".repeat(n)),
        "if" => format!("{}x{}", "if x > k { ".repeat(n), " } else { k * x }".repeat(n)),
        "elseif" => format!("if x > 0.0 {{ x }} {} else {{ k * x }}", "else if x > k { x * 2.0 }".repeat(n)),
        "sum" => (0..n).map(|i| format!("{i}.5 * x")).collect::<Vec<_>>().join(" + "),
        "let" => format!("let y = x; {} y", "let y = (y * k + x).sin();".repeat(n)),
        "neg" => format!("{}x", "-".repeat(n)),
        "closure" => (0..n).fold("let f = |y: f64| y.sin();".to_owned(), |all, _| format!("{all} let f = |y: f64| f(y) + k;")) + "f(x)",
        _ => panic!(),
    };
    let item: TokenStream = format!("fn f(x: Coord, k: f64, n: usize) -> f64 {{ {body} }}").parse().unwrap();
    match std::env::var("STAGE").as_deref() {
        Ok("parse") => { let s = crate::parse::constraint(TokenStream::new(), item).ok().unwrap(); std::mem::forget(s); }
        Ok("lower") => { let s = crate::parse::constraint(TokenStream::new(), item).ok().unwrap(); let l = crate::lower::constraint(&s); println!("read {}", l.is_ok()); std::mem::forget((s, l)); }
        Ok("dual") => { let s = expand::constraint("dual".parse().unwrap(), item); std::mem::forget(s); }
        _ => { let t = std::time::Instant::now(); let s = expand::constraint(TokenStream::new(), item); println!("took {:?}", t.elapsed()); std::mem::forget(s); }
    }
}
