use proc_macro2::TokenStream;
#[test]
fn limits() {
    let n: usize = std::env::var("N").unwrap().parse().unwrap();
    let body = match std::env::var("PAT").unwrap().as_str() {
        "grow" => format!("let mut s = x; for _ in 0..{n} {{ s = s.sin() * s.cos() + s; }} s"),
        "nest" => format!("let mut s = x; for a in 0..{n} {{ for b in 0..4000 {{ s += k; }} }} s"),
        "poly" => format!("let mut s = x; for a in 0..{n} {{ s += (a as f64 + 0.5) * x.powi(a); }} s"),
        "clos" => {
            (0..n).fold("let f0 = |y: f64| y.sin();".to_owned(), |all, i| format!("{all} let f{} = |y: f64| f{i}(y) + f{i}(k * y);", i + 1))
                + &format!("f{n}(x)")
        }
        p => panic!("{p}"),
    };
    let item: TokenStream = format!("fn f(x: Coord, k: f64, n: usize) -> f64 {{ {body} }}").parse().unwrap();
    let t = std::time::Instant::now();
    let s = crate::parse::constraint(TokenStream::new(), item).ok().unwrap();
    println!("parse {:?}", t.elapsed());
    let t = std::time::Instant::now();
    let l = crate::lower::constraint(&s);
    println!("lower {:?}", t.elapsed());
    let Ok(mut l) = l else {
        println!("not read");
        return;
    };
    println!("nodes {}", l.graph.len());
    let t = std::time::Instant::now();
    let d = crate::differentiate::Derivatives::new(&mut l, &s.arguments);
    println!("differentiate {:?} nodes {}", t.elapsed(), l.graph.len());
    std::mem::forget(d);
    let t = std::time::Instant::now();
    let e = crate::emit::constraint::symbolic(&s, l);
    println!("emit incl. diff {:?}", t.elapsed());
    println!("tokens {}", e.to_string().len());
}
#[test]
fn each() {
    for body in ["let mut m = n; for _ in 0..4000 { m = m + 1; } x * m as f64","let m = n; %s x * m as f64","let mut s = x; for _ in 0..1000000 { s += k; } s","let mut s = x; for a in 0..4000 { for b in 0..4000 { for c in 0..4000 { s += k; } } } s","let mut s = x; for _ in 0..4000 { s = s.sin() * s.cos() + s; } s","let a = [x; 1000000]; a[0]","let a = [[[x; 400]; 400]; 400]; a[0][0][0]","let a = [[[[x; 4000]; 4000]; 4000]; 4000]; a[0][0][0][0]","let a = (x, x); let a = (a, a); let a = (a, a);let a = (a, a);let a = (a, a);let a = (a, a);let a = (a, a);let a = (a, a);let a = (a, a);let a = (a, a);let a = (a, a);let a = (a, a);let a = (a, a);let a = (a, a);let a = (a, a);let a = (a, a);let a = (a, a);let a = (a, a);let a = (a, a);let a = (a, a);let a = (a, a);let a = (a, a);let a = (a, a);let a = (a, a); x"] {
        let body = body.replace("%s", &"let m = m + m;".repeat(60)); println!("{}", &body[..body.len().min(60)]);
        let item: TokenStream = format!("fn f(x: Coord, k: f64, n: usize) -> f64 {{ {body} }}").parse().unwrap();
        let t = std::time::Instant::now();
        let s = crate::expand::constraint(TokenStream::new(), item).to_string();
        println!("  {:?} {} {}", t.elapsed(), s.contains("Dual"), s.len());
    }
}
