//! Bars of a tolerance, as anyone gets them: by name, by size and by number, those of its table.

use kin::joints::drivers::drive;
use kin::{Law, Mechanism};
use kin_view::Bars;

/// Contributions of known sizes: x = a − 3 b + c² / 2 + d at c = 4, off by 0.5, 0.2, 0.05 and 0.1.
fn tolerance() -> kin::Result<kin::design::Tolerance> {
    let mut m = Mechanism::new("stack");
    let [a, b, c, d] = [("a", 1.0, 0.5), ("b < b", 2.0, 0.2), ("c", 4.0, 0.05), ("d", 1.0, 0.1)]
        .map(|(name, value, off)| m.dimension(name, value).map(|one| one.tolerance(off)));
    let d = d?.distributed(kin::design::Distribution::Uniform);
    let x = m.length("x", 0.0)?;
    let c = c?;
    m.add("motor", drive(x, Law::constant(a? - 3.0 * b? + c * c / 2.0 + d)))?;
    let system = m.build()?;
    system.tolerance(&system.run([0.0])?, x)
}

/// The number of an attribute in a line of a picture.
fn number(line: &str, attribute: &str) -> f64 {
    let start =
        line.find(&format!(" {attribute}=\"")).expect("the attribute") + attribute.len() + 3;
    line[start..].split('"').next().expect("its end").parse().expect("a number")
}

#[test]
fn bars_are_those_of_the_table_the_largest_first() -> kin::Result<()> {
    let tolerance = tolerance()?;
    let svg = Bars::new(&tolerance, "s").svg();
    super::parsed(&svg);
    // Names in the order of the table, and numbers beside them.
    let named = |name: &str| {
        svg.find(&format!(">{name}</text>")).unwrap_or_else(|| panic!("{name}\n{svg}"))
    };
    let places = ["b &lt; b", "a", "c", "d"].map(named);
    assert!(places.is_sorted(), "{svg}");
    for told in
        ["43 %   −0.6 m", "36 %   +0.5 m", "14 %   +0.2 m", "7 %   +0.1 m", "± 1.4 m worst case"]
    {
        assert!(svg.contains(told), "{told}\n{svg}");
    }
    // Two bars a row, as long as the shares of the worst case and of the variance, in the color of
    // the sign.
    let bars: Vec<&str> = svg.lines().filter(|line| line.contains("fill-opacity")).collect();
    assert_eq!(bars.len(), 8);
    let variance = [0.04, 0.25 / 9.0, 0.04 / 9.0, 0.01 / 3.0];
    let of_variance = variance.map(|x| x / variance.iter().sum::<f64>());
    let shares = [0.6, 0.5, 0.2, 0.1].map(|off| off / 1.4);
    let scale = number(bars[1], "width") / of_variance[0];
    for (k, row) in bars.chunks(2).enumerate() {
        assert!((number(row[0], "width") - scale * shares[k]).abs() < 0.02, "{k} {row:?}");
        assert!((number(row[1], "width") - scale * of_variance[k]).abs() < 0.02, "{k} {row:?}");
        let color = |line: &str| {
            line.split("fill=\"").nth(1).and_then(|rest| rest.split('"').next()).map(str::to_string)
        };
        assert_eq!(color(row[0]), color(row[1]));
        assert_eq!(color(row[0]) == color(bars[0]), k == 0, "only `b < b` makes it smaller");
    }
    assert!(bars.iter().all(|bar| number(bar, "x") + number(bar, "width") < 640.0));
    Ok(())
}
