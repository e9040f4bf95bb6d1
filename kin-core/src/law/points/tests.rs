use super::*;
use crate::law::tests::{listed, shown};

fn points(table: &[(f64, f64)], ends: Ends) -> Points {
    Points { table: table.to_vec(), ends }
}

const TABLE: [(f64, f64); 4] = [(-1.0, 2.0), (0.0, 3.0), (2.0, -1.0), (3.0, 2.0)];
const CLAMPED: Ends = Ends::Clamped { start: 0.5, end: -2.0 };

#[test]
fn intervals_and_places() {
    let natural = points(&TABLE, Ends::Natural);
    assert_eq!([0, 1, 2].map(|k| natural.step(k)), [(1.0, 1.0), (2.0, -4.0), (1.0, 3.0)]);
    assert_eq!([0, 1, 2].map(|k| natural.interval(k)), [(1.0, 1.0), (2.0, -2.0), (1.0, 3.0)]);
    assert_eq!(
        [-1.5, -1.0, -0.5, 0.0, 2.0, 3.0, 9.0].map(|x| natural.place(x)),
        [(-1.5, 0), (-1.0, 1), (-0.5, 1), (0.0, 2), (2.0, 3), (3.0, 3), (9.0, 4)]
    );
    let periodic = points(&TABLE, Ends::Periodic);
    assert_eq!(
        [-1.5, -1.0, -0.5, 2.5, 3.0, 5.0, -9.0].map(|x| periodic.place(x)),
        [(2.5, 3), (-1.0, 1), (-0.5, 1), (2.5, 3), (-1.0, 1), (1.0, 2), (-1.0, 1)]
    );
    // A repeating profile is inside its bounds, whatever rounding does.
    let mut random = crate::numbers::random::Random::new(1);
    for _ in 0..3000 {
        let first = random.number();
        let last = 2.0 + random.number();
        let table =
            points(&[(first, 0.0), (0.5 * (first + last), 1.0), (last, 0.0)], Ends::Periodic);
        for x in [
            last,
            last.next_down(),
            first,
            first.next_down(),
            last + (last - first),
            1e3 * random.number(),
        ] {
            let (x, after) = table.place(x);
            assert!(first <= x && x < last && (1..=2).contains(&after), "{first} {last} {x}");
        }
    }
}

#[test]
fn tables_that_make_no_sense() {
    let said =
        |table: &[(f64, f64)], ends| points(table, ends).refusal("spline").unwrap_or_default();
    assert_eq!(
        said(&TABLE[..1], Ends::Natural),
        "spline: the table has 1 point. Give at least 2 points"
    );
    assert_eq!(
        said(&TABLE[..2], Ends::Periodic),
        "spline: the table has 2 points. Give at least 3 points"
    );
    assert_eq!(
        (
            said(&TABLE[..2], Ends::Natural),
            said(&TABLE[..2], CLAMPED),
            said(&TABLE, Ends::Periodic)
        ),
        (String::new(), String::new(), String::new())
    );
    assert_eq!(
        said(&[(0.0, 1.0), (1.0, f64::NAN)], Ends::Natural),
        "spline: point 2 is (1, NaN). Give finite numbers"
    );
    assert_eq!(
        said(&[(f64::NEG_INFINITY, 1.0), (1.0, 0.0)], Ends::Natural),
        "spline: point 1 is (-inf, 1). Give finite numbers"
    );
    assert_eq!(
        said(&[(0.0, 1.0), (1.0, 0.0), (1.0, 2.0)], Ends::Natural),
        "spline: the values of x must increase, but x = 1 is followed by 1 (point 3)"
    );
    assert_eq!(
        said(&[(0.0, 1.0), (-1.0, 0.0)], Ends::Natural),
        "spline: the values of x must increase, but x = 0 is followed by -1 (point 2)"
    );
    assert_eq!(
        said(&[(0.0, 1.0), (f64::NAN, 2.0), (1.0, f64::NAN)], Ends::Natural),
        "spline: point 2 is (NaN, 2). Give finite numbers"
    );
    let twice = [(0.0, 1.0), (-1.0, 0.0), (2.0, 0.0), (1.0, 0.0)];
    assert_eq!(
        said(&twice, Ends::Natural),
        "spline: the values of x must increase, but x = 0 is followed by -1 (point 2)"
    );
    let open =
        |y: f64, off: f64| said(&[(0.0, y), (1.0, -3.0 * y), (2.0, y + off)], Ends::Periodic);
    assert_eq!(
        open(1.0, 0.5),
        "spline: the first and the last y of a periodic table must be equal, but the first is 1 and the last is 1.5"
    );
    for y in [1.0, -1.0, 1e9, -1e-9] {
        // nine digits of the largest
        assert_eq!((open(y, 2.9e-9 * y), open(y, -2.9e-9 * y)), (String::new(), String::new()));
        assert!(!open(y, 3.6e-9 * y).is_empty() && !open(y, -3.6e-9 * y).is_empty());
    }
    assert_eq!(
        (open(0.0, 0.0), said(&[(0.0, 1.0), (1.0, 3.0)], Ends::Natural)),
        (String::new(), String::new())
    );
}

#[test]
fn numbers_of_a_table() {
    let fixed = |ends| points(&TABLE, ends).fixed_numbers();
    let x: Vec<(String, f64)> =
        TABLE.iter().enumerate().map(|(k, (x, _))| (format!("x[{k}]"), *x)).collect();
    let and = |more: &[(&str, f64)]| {
        x.iter()
            .cloned()
            .chain(more.iter().map(|(name, value)| (name.to_string(), *value)))
            .collect::<Vec<_>>()
    };
    assert_eq!(
        (fixed(Ends::Natural), fixed(CLAMPED), fixed(Ends::Periodic)),
        (and(&[]), and(&[("start", 0.5), ("end", -2.0)]), and(&[("periodic", 1.0)]))
    );
    for law in [Law::spline, Law::quintic_spline] {
        assert_eq!(law(&TABLE, CLAMPED).fixed_numbers(), and(&[("start", 0.5), ("end", -2.0)]));
        assert_eq!(
            shown(&law(&TABLE, CLAMPED)),
            [2.0, 3.0, -1.0, 2.0]
                .iter()
                .enumerate()
                .map(|(k, y)| (format!("y[{k}]"), *y))
                .collect::<Vec<_>>()
        );
    }
    let changed = |ends, name: &str| {
        points(&TABLE, ends)
            .with_parameter(name, 7.0)
            .map(|points| points.table.iter().map(|point| point.1).collect::<Vec<_>>())
    };
    assert_eq!(
        (changed(Ends::Natural, "y[0]"), changed(CLAMPED, "y[3]")),
        (Some(vec![7.0, 3.0, -1.0, 2.0]), Some(vec![2.0, 3.0, -1.0, 7.0]))
    );
    let both = Some(vec![7.0, 3.0, -1.0, 7.0]);
    assert_eq!(
        (changed(Ends::Periodic, "y[0]"), changed(Ends::Periodic, "y[3]")),
        (both.clone(), both)
    );
    assert_eq!(changed(Ends::Periodic, "y[2]"), Some(vec![2.0, 3.0, 7.0, 2.0]));
    assert!(["y[4]", "x[0]", "y", ""].iter().all(|name| changed(Ends::Natural, name).is_none()));
    assert_eq!(
        points(&TABLE, CLAMPED).with_parameter("y[0]", 7.0).map(|points| points.ends),
        Some(CLAMPED)
    );
}

/// A file in a folder of its own, read as a law.
fn read(name: &str, text: &[u8]) -> std::result::Result<Law, String> {
    let path = std::env::temp_dir().join(format!("kin-{}-{name}.csv", std::process::id()));
    std::fs::write(&path, text).expect("is written");
    let law = Law::spline_from_csv(&path, Ends::Natural);
    let quintic = Law::quintic_spline_from_csv(&path, Ends::Natural);
    std::fs::remove_file(&path).expect("is removed");
    assert_eq!((law.is_ok(), quintic.is_ok()), (law.is_ok(), law.is_ok()));
    law.map_err(|error| error.to_string().replace(&path.display().to_string(), "FILE"))
}

#[test]
fn tables_from_files() {
    let same = |text: &str| {
        let law = read("same", text.as_bytes()).expect("is a table");
        assert_eq!(
            (shown(&law), law.fixed_numbers()),
            (
                shown(&Law::spline(&TABLE, Ends::Natural)),
                Law::spline(&TABLE, Ends::Natural).fixed_numbers()
            )
        );
        assert_eq!(listed(&law, -9.0, 9.0).len(), 4);
    };
    same("-1,2\n0,3\n2,-1\n3,2\n");
    same("t [s],x [m]\n -1 , 2,note\n0,3\n2,-1,,\n3,2");
    let said = |text: &str| read("said", text.as_bytes()).err().unwrap_or_default();
    assert!(
        said("t,x\n0,1\n1,two\n").ends_with("line 3: `1,two` is not two numbers"),
        "{}",
        said("t,x\n0,1\n1,two\n")
    );
    assert!(said("0,1\nt,x\n").ends_with("line 2: `t,x` is not two numbers"));
    assert!(said("0,1\n1\n").ends_with("line 2: `1` is not two numbers"));
    assert!(said("0,1\n0,2\n").contains("x must increase, but x = 0 is followed by 0 (point 2)"));
    let semicolons = "columns are separated by semicolons. Separate them by commas";
    assert!(said("t;x\n0;1\n1;2\n").contains("line 1: ") && said("t;x\n").contains(semicolons));
    assert!(said("0,5;1,2\n1,5;2,2\n").contains(semicolons));
    assert!(said("t,x\n0;1\n").contains("line 2: columns are separated by semicolons"));
    assert!(said("t,x\n0,1\n").contains("the table has 1 point. Give at least 2"));
    assert!(said("t,x\n").contains("the table has 0 points. Give at least 2"));
    assert!(read("broken", &[b'0', b',', 0xff, b'\n', b'1', b',', 0xff]).is_err());
    assert!(
        Law::spline_from_csv("/no/such/file.csv", Ends::Natural)
            .is_err_and(|error| error.to_string().contains("file.csv"))
    );
}
