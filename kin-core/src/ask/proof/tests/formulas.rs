//! Formulas with bounds: what is read of them, what cannot be, and what is told of it.

use kin_graph::{Formula, Node, Number, evaluate};

use crate::ask::proof::bounds::Bounds;
use crate::ask::proof::bounds::Part;
use crate::extend::RouteReason;
use crate::law::{Law, LawFunction};
use crate::model::constraint::{Entry, Facts, Parts, Written};
use crate::model::formula::bounds::{Inputs, opaque, row, trusted};
use crate::model::formula::time::{can_jump, over_time, signals, slopes};
use crate::model::formula::{Given, Outside, Table, give_law, nothing_outside};
use crate::model::state::{At, Rates};
use crate::numbers::enclosure::interval::{Interval, ONE};
use crate::numbers::enclosure::series::{ORDER, Series};
use crate::numbers::real::Dual3_64;
use crate::{Constraint, Mechanism, constraint};

const FULL: usize = ORDER + 1;

fn formula(text: &str) -> Formula {
    text.parse().unwrap_or_else(|error| panic!("{error:?}"))
}

/// Row 0 of a formula of column 0.
fn first(text: &str, x: Series, outside: Outside<'_>) -> Series {
    let formula = formula(text);
    let inputs = Inputs { columns: &[x], t: Series::number(0.5), parameters: &[2.0], outside };
    row(&formula, 0, &evaluate(&formula.graph, &formula.rows, &inputs))
}

fn over(lo: f64, hi: f64) -> Series {
    Series::variable(Interval::new(lo, hi), ONE, FULL)
}

/// A decimal is between the number next to it and the one beyond.
#[test]
fn decimals_are_between_two_numbers() {
    let found = |above: bool| <Series as Number>::decimal(0.1, above).values();
    assert_eq!([found(true), found(false)], [[0.1, 0.1_f64.next_up()], [0.1_f64.next_down(), 0.1]]);
    assert_eq!(<Series as Number>::powi(Series::number(2.0), 3).values().map(f64::round), [8.0; 2]);
}

/// The user's own function of parameters is evaluated at both ends and in the middle of their
/// interval; where coordinates move its arguments, nothing is known of it.
#[test]
fn the_users_own_functions() {
    const OF_PARAMETER: &str =
        "\nparameters k\nrows 2\n- Parameter 0\n- Decimal 0.1 1\n- Foreign 0 0 1";
    const OF_COLUMN: &str = "\nparameters\nrows 2\n- Column 0\n- Constant 1.0\n- Foreign 0 0 0 1";
    let with = |f: fn(f64) -> f64| {
        move |_: usize, x: &[Dual3_64], to: &mut Given| to.push(Dual3_64::from_re(f(x[0].re)))
    };
    let values = |text: &str, f: fn(f64) -> f64, x: Series| first(text, x, &with(f)).values();
    let everything = [f64::NEG_INFINITY, f64::INFINITY];
    assert_eq!(values(OF_PARAMETER, |x| 2.0 * x, over(0.0, 1.0)), [0.2, 2.0 * 0.1_f64.next_up()]);
    assert_eq!(
        values(OF_PARAMETER, |x| if x == 0.1 { 1.0 } else { 5.0 }, over(0.0, 1.0)),
        [1.0, 5.0]
    );
    assert_eq!(first(OF_PARAMETER, over(0.0, 1.0), &with(|_| f64::NAN)).len(), 0);
    assert!(first(OF_PARAMETER, over(0.0, 1.0), &with(|x| x)).is_constant());
    let square =
        |x: Series| values(OF_COLUMN, |x| if (x - 0.5).abs() < 0.1 { 9.0 } else { x * x }, x);
    assert_eq!(
        [
            square(over(0.0, 1.0)),
            square(Series::number(2.0)),
            square(Series::constant(Interval::new(0.0, 1.0)))
        ],
        [everything, [4.0; 2], [0.0, 9.0]]
    );
    let open = over(-0.1, 0.1).call2(kin_graph::Function2::Atan2, Series::number(-1.0));
    assert_eq!(
        [square(open), square(Series::constant(open_value(&open)).up_to_turns(&open))],
        [everything; 2]
    );
}

fn open_value(open: &Series) -> Interval {
    open.at(0)
}

impl Series {
    /// The same number, known up to the turns of another one.
    fn up_to_turns(self, other: &Series) -> Series {
        self.up_to(other.turns())
    }
}

/// A law that tells no bounds.
#[derive(Clone)]
struct Silent;

impl LawFunction for Silent {
    fn jet(&self, x: f64) -> [f64; 4] {
        [x, 1.0, 0.0, 0.0]
    }
}

#[test]
fn why_a_formula_cannot_be_read() {
    let reason = |text: &str, law: Law| {
        opaque(&formula(text), &move |_, x, to| give_law(&law, x, to)).unwrap_or_default()
    };
    const LAW: &str = "\nparameters\nrows 1\n- Time\n- Law 0 0 0";
    assert_eq!(reason(LAW, Law::ramp(1.0)), "");
    assert!(reason(LAW, Law::new(Silent)).contains("Kin has no bounds of the law"));
    let rounded = reason("\nparameters\nrounded\nrows 0\n- Column 0", Law::ramp(1.0));
    assert_eq!(rounded, "rustc rounds the constants of the equation before Kin reads them");
    assert_eq!(
        reason("\nparameters k\nrows 1\n- Parameter 0\n- Foreign 0 0 0", Law::ramp(1.0)),
        ""
    );
    assert!(
        reason("\nparameters\nrows 1\n- Column 0\n- Foreign 0 0 0", Law::ramp(1.0))
            .contains("the equation calls a user-defined function")
    );
    static READ: Table = Table::new("law.rs", "\nparameters\nrows 1\n- Column 0\n- Foreign 0 0 0");
    assert!(READ.law_over(&over(0.0, 1.0), &[], &nothing_outside).is_none());
    assert!(trusted(&formula(LAW), &|_, x, to| give_law(&Law::ramp(1.0), x, to)).is_empty());
}

/// A law's slope is known as far as its values are, less one; one that may itself jump is none.
#[test]
fn slopes_of_laws() {
    let of = |order: u8, law: Law, x: Series| {
        let text = format!("\nparameters\nrows 1\n- Column 0\n- Law 0 0 {order}");
        first(&text, x, &move |_, x, to| give_law(&law, x, to))
    };
    assert_eq!(
        [
            of(0, Law::sine(1.0, 1.0, 0.0), over(0.1, 0.2)).len(),
            of(1, Law::sine(1.0, 1.0, 0.0), over(0.1, 0.2)).len()
        ],
        [FULL, ORDER]
    );
    let kink = Law::sequence(0.0, [(1.0, Law::ramp(1.0)), (1.0, Law::linear(1.0, -1.0))]);
    let bend =
        Law::sequence(0.0, [(1.0, Law::ramp(0.0)), (1.0, Law::polynomial(&[0.0, 0.0, 1.0]))]);
    assert_eq!(
        [of(0, kink.clone(), over(0.9, 1.1)).len(), of(1, kink, over(0.9, 1.1)).len()],
        [2, 0]
    );
    assert_eq!(
        [of(0, bend.clone(), over(0.9, 1.1)).len(), of(1, bend, over(0.9, 1.1)).len()],
        [3, 2]
    );
    let cosine = of(1, Law::sine(2.0, 3.0, 0.0), Series::number(0.2));
    assert!(
        cosine.value().contains(6.0 * 0.6_f64.cos())
            && cosine.value().radius() < 1e-13
            && cosine.is_constant()
    );
    assert_eq!(of(0, Law::constant(3.0), crate::numbers::enclosure::series::UNKNOWN).len(), 0);
    assert_eq!(of(0, Law::ramp(1.0), crate::numbers::enclosure::series::UNKNOWN).len(), 0);
}

/// The innermost expression of which too little is known, by way of what can be chosen.
#[test]
fn the_expression_without_bounds() {
    static TABLE: Table = Table::new(
        "cam.rs",
        "\nat 1 1 x.floor()\nat 1 9 if x > 0 {} else {}\nat 2 1 all\nat 3 1 x.sqrt()\nparameters\nrows 6 8\n- Column 0\n0 Floor 0\n- Constant 0.0\n- Greater 0 2\n3 Sqrt 0\n1 Select 3 1 4\n2 Sum 5 0\n- Constant 2.0\n2 Product 5 7",
    );
    let told = |lo: f64, hi: f64, len: usize| {
        let formula = TABLE.formula();
        let inputs = Inputs {
            columns: &[over(lo, hi)],
            t: Series::number(0.0),
            parameters: &[],
            outside: &nothing_outside,
        };
        let results = evaluate(&formula.graph, &formula.rows, &inputs);
        TABLE.unknown(0, &results, len).map(|(text, _)| text)
    };
    assert_eq!(told(0.5, 1.5, 1).as_deref(), Some("x.floor()"));
    assert_eq!(told(-1.5, -0.5, 1).as_deref(), Some("x.sqrt()"));
    assert_eq!(told(0.0, 0.0, 2).as_deref(), Some("x.sqrt()"));
    assert_eq!(told(-0.1, 0.1, 1).as_deref(), Some("x.floor()"));
}

/// An expression that is known as far as it is asked for is not blamed, though it stands first.
#[test]
fn an_expression_that_is_known_is_not_told() {
    static TABLE: Table = Table::new(
        "cam.rs",
        "\nat 1 1 x.sqrt()\nat 2 1 x.floor()\nat 3 1 all\nparameters\nrows 3\n- Column 0\n0 Sqrt 0\n1 Floor 0\n2 Sum 1 2",
    );
    let formula = TABLE.formula();
    let inputs = Inputs {
        columns: &[over(0.0, 1.0)],
        t: Series::number(0.0),
        parameters: &[],
        outside: &nothing_outside,
    };
    let results = evaluate(&formula.graph, &formula.rows, &inputs);
    assert_eq!(
        [1, 2].map(|len| TABLE.unknown(0, &results, len).map(|(text, _)| text)),
        [Some("x.floor()"), Some("x.sqrt()")].map(|text| text.map(str::to_string))
    );
}

fn numbers(nodes: &[Node]) -> Vec<usize> {
    nodes.iter().map(|node| node.index()).collect()
}

/// The time acts on a formula through signals: the outermost expressions that it alone moves, and
/// rows that it alone moves.
#[test]
fn signals_are_what_time_moves() {
    // Rows: sin(k t) x, x, (k t)², k x.
    let text = "\nparameters k\nrows 5 0 6 7\n- Column 0\n- Time\n- Parameter 0\n- Product 1 2\n- Sin 3\n- Fused\n";
    let text = text.replace("- Fused\n", "- Product 4 0\n- Product 3 3\n- Product 2 0\n");
    let of = |text: &str| {
        let formula = formula(text);
        (numbers(&signals(&formula)), formula)
    };
    let (found, known) = of(&text);
    let sine = known
        .graph
        .operands(known.rows[0])
        .into_iter()
        .find(|node| known.graph.depends(*node).on_t)
        .unwrap();
    let mut expected = vec![sine.index(), known.rows[2].index()];
    expected.sort_unstable();
    assert_eq!(found, expected);
    let values = over_time(&known, &signals(&known), over(0.0, 0.1), &[2.0], &nothing_outside);
    assert!(values.iter().all(|y| y.len() == FULL));
    let found = slopes(&known, &signals(&known), (&[3.0], 0.5), &[2.0], &nothing_outside);
    let of_sine = &found[expected.iter().position(|k| *k == sine.index()).unwrap()];
    let of_square = &found[expected.iter().position(|k| *k != sine.index()).unwrap()];
    assert_eq!((of_sine, of_square), (&vec![3.0, 0.0, 0.0, 0.0], &vec![0.0, 0.0, 1.0, 0.0]));
    assert!(of("\nparameters\nrows 0\n- Column 0").0.is_empty());
}

/// A condition that may change and an angle that may pass its cut are not known; no more is a slope
/// where there is none.
#[test]
fn signals_that_are_not_known() {
    let over = |text: &str, lo: f64, hi: f64| {
        let formula = formula(text);
        let found = over_time(&formula, &signals(&formula), over(lo, hi), &[], &nothing_outside);
        found.iter().map(Series::len).collect::<Vec<_>>()
    };
    let condition = "\nparameters\nrows 5\n- Column 0\n- Time\n- Constant 0.05\n- Less 1 2\n- Negated 0\n- Select 3 0 4";
    assert_eq!(
        [over(condition, 0.0, 0.01), over(condition, 0.0, 0.1), over(condition, 0.06, 0.1)],
        [[FULL], [0], [FULL]]
    );
    let angle =
        "\nparameters\nrows 4\n- Column 0\n- Time\n- Constant -1.0\n- Atan2 1 2\n- Product 0 3";
    assert_eq!([over(angle, 0.1, 0.2), over(angle, -0.1, 0.2)], [[FULL], [0]]);
    let length = formula("\nparameters\nrows 2\n- Column 0\n- Time\n- Hypot 0 1");
    let slope =
        |x: f64, t: f64| slopes(&length, &signals(&length), (&[x], t), &[], &nothing_outside)[0][0];
    assert!(slope(0.0, 0.0).is_nan() && (slope(3.0, 4.0) - 0.8).abs() < 1e-14);
}

#[test]
fn what_can_jump_where_coordinates_move() {
    let jumps = |step: &str| {
        can_jump(&formula(&format!(
            "\nparameters k\nrows 4\n- Column 0\n- Time\n- Parameter 0\n- Less 0 1\n- {step}"
        )))
    };
    for step in [
        "Floor 0",
        "Ceil 0",
        "Round 0",
        "Trunc 0",
        "Fract 0",
        "Signum 0",
        "Rem 0 2",
        "RemEuclid 0 2",
        "DivEuclid 0 2",
        "Select 3 0 1",
        "Foreign 0 0 0",
    ] {
        assert!(jumps(step), "{step}");
    }
    for step in ["Sin 0", "Abs 0", "Max 0 1", "Floor 1", "Product 0 1", "Rem 1 2", "Foreign 0 0 2"]
    {
        assert!(!jumps(step), "{step}");
    }
}

/// A law of one's own that tells its bounds.
#[derive(Clone)]
struct Trusted;

impl LawFunction for Trusted {
    fn jet(&self, x: f64) -> [f64; 4] {
        [x, 1.0, 0.0, 0.0]
    }

    fn kind(&self) -> &str {
        "trusted"
    }

    fn over(&self, x: &Series) -> Option<Series> {
        Some(*x)
    }
}

#[constraint]
fn twice(x: Coord, law: Law, t: Time) -> f64 {
    law.at(x) - law.at(t)
}

#[constraint]
fn steep(x: Coord, k: f64) -> f64 {
    x * k * k
}

#[constraint]
fn stepped(x: Coord, y: Coord) -> [f64; 2] {
    [x - y, y - x.floor()]
}

/// By hand, with a formula of one of its two rows.
#[derive(Clone)]
struct Half(crate::coordinates::Coordinate);

impl Constraint for Half {
    fn facts(&self) -> Facts<'_> {
        const FACTS: Facts<'static> = Facts {
            rows: &["1", "2"],
            pattern: &[Entry::new(0, 0), Entry::new(1, 0)],
            reason: RouteReason::Read,
            ..Facts::of("half")
        };
        FACTS
    }

    fn arguments(&self) -> Vec<crate::coordinates::Argument> {
        vec![crate::coordinates::Argument {
            name: "x",
            target: crate::coordinates::Target::Coord(self.0, crate::coordinates::Trig::Unused),
        }]
    }

    fn residual(&self, _: &At<'_>, c: &mut [f64]) {
        c.fill(0.0);
    }

    fn jacobian(&self, _: &At<'_>, c_q: &mut [f64]) {
        c_q.fill(1.0);
    }

    fn velocity_rhs(&self, _: &At<'_>, rhs: &mut [f64]) {
        rhs.fill(0.0);
    }

    fn acceleration_rhs(&self, _: &At<'_>, _: &Rates<'_>, _: f64, q_d: &mut [f64]) {
        q_d.fill(0.0);
    }

    fn parts(&self) -> Parts<'_> {
        Parts { written: Some(self), ..Parts::default() }
    }
}

impl Written for Half {
    fn table(&self) -> Option<(&Table, Vec<f64>)> {
        static TABLE: Table = Table::new("half.rs", "\nparameters\nrows 0\n- Column 0");
        Some((&TABLE, Vec::new()))
    }
}

/// Laws that are believed are told once each, in order; equations without bounds by their number
/// among all.
#[test]
fn the_equations_of_a_system() {
    let mut m = Mechanism::new("system");
    let [x, y, z] = ["x", "y", "z"].map(|name| m.length(name, 0.0).unwrap());
    for (name, coordinate) in [("second", x), ("first", y)] {
        m.add(name, twice(coordinate, Law::new(Trusted))).unwrap();
    }
    m.add("step", stepped(z, x)).unwrap();
    let system = m.build().unwrap();
    let bounds = Bounds::new(&system).unwrap();
    assert_eq!(bounds.trusted(), ["`trusted` in `first`", "`trusted` in `second`"]);
    let q = [Series::number(0.5), Series::number(0.5), over(0.9, 1.1)];
    assert_eq!(bounds.residual(&q, Series::number(0.0)).map(|_| ()).unwrap_err().row, 3);
    let known = [Series::number(0.5), Series::number(0.5), over(0.5, 0.6)];
    assert_eq!(bounds.residual(&known, Series::number(0.0)).unwrap().len(), 4);
}

/// A constraint alone has bounds if all of it can be read; where a slope has no bound the equation
/// is not known.
#[test]
fn one_constraint_alone() {
    let mut m = Mechanism::new("alone");
    let x = m.length("x", 0.0).unwrap();
    let steep = steep(x, 1e200);
    let half = Half(x);
    let part = Part::alone(&steep).unwrap();
    let tiny = Interval::new(-1e-300, 1e-300);
    let mut c = Vec::new();
    let mut c_q = Vec::new();
    assert!(
        part.residual(&[Series::constant(tiny)], Series::number(0.0), &mut c).is_ok()
            && c[0].value().contains(1e100)
    );
    assert!(part.jacobian(&[tiny], Interval::from(0.0), &mut c_q).is_err());
    assert!(Part::alone(&half).is_none());
    let error = m
        .add("half", half)
        .and_then(|_| m.build())
        .map(|system| Bounds::new(&system).map(|_| ()).unwrap_err().to_string());
    assert!(
        error.as_ref().is_ok_and(|error| error.contains("the equation has too many operations")),
        "{error:?}"
    );
}
