//! The methods that the interpreter reads, a row each: the receivers that have the method, its
//! names, how many arguments it takes, and its rule. The functions of `kin-graph`'s list are
//! methods of numbers too.

use std::collections::HashMap;
use std::rc::Rc;
use std::sync::LazyLock;

use super::Reader;
use super::rules::{Body, Holder, List, variant};
use crate::lower::methods::Call;
use crate::lower::methods::lists::{self, borrowed, option};
use crate::lower::methods::numbers::{class_of, degrees, radians};
use crate::lower::values::{
    Adt, Components, Endless, Function as Callee, IntegerType, Place, Read, Unreadable, Value,
    Values, order_named, transpose,
};
use kin_graph::{Function, Function2, Graph, Node};

/// The kinds of receivers.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Receiver {
    Number,
    Integer,
    Condition,
    Vector2,
    Vector3,
    Matrix,
    Euler,
    /// The state of a body.
    Body,
    Law,
    /// An array, or an iterator over a known list of values.
    List,
    /// A variable that holds an array; the method changes it.
    ListVariable,
    /// A variable that holds an iterator; the method takes values from it.
    IteratorVariable,
    /// A variable that holds an `Option`; the method changes it.
    HolderVariable,
    /// An iterator without an end.
    Endless,
    /// `Option` or `Result`.
    Holder,
    /// `Ordering`.
    Order,
}

/// A row of the table.
pub struct Method {
    receivers: &'static [Receiver],
    names: &'static [&'static str],
    /// The number of arguments, or [`ANY`].
    takes: usize,
    pub rule: Rule,
}

/// The number of arguments of a method whose rule counts them.
const ANY: usize = usize::MAX;

type Edit = fn(&mut Vec<Value>, &[Value], &[usize]) -> Option<()>;

/// The way to a method's value.
#[derive(Clone, Copy)]
pub enum Rule {
    /// From the receiver and the arguments, all of them numbers.
    Numbers(fn(&mut Graph, &[Node]) -> Value),
    /// From a number or a condition, and arguments of any kind.
    Node(fn(&mut Reader, Node, &Call) -> Read),
    /// An integer from an integer and the argument; `None` if the operation may overflow.
    Integer(fn(i64, i64, Option<IntegerType>) -> Option<i64>),
    /// Another value from an integer and the argument.
    OfInteger(fn(&mut Graph, i64, i64) -> Option<Value>),
    /// From the components of a vector, a matrix or Euler parameters, without arguments.
    Alone(fn(&mut Values, Components, &[Node]) -> Value),
    /// From such components, and those of the argument, which is of the same kind.
    Pair(fn(&mut Values, Components, &[Node], &[Node]) -> Value),
    /// From such components, and arguments of any kind.
    Components(fn(&mut Reader, Components, &[Node], &Call) -> Read),
    Body(fn(&mut Reader, Body, &Call) -> Read),
    /// The derivative of this order of a law.
    Law(u8),
    /// From the elements of a list, without arguments.
    Elements(fn(&mut Values, Vec<Value>) -> Value),
    List(fn(&mut Reader, List, &Call) -> Read),
    /// From a list and the number in the argument, or 0; `None` if the number is out of range.
    Picked(fn(Vec<Value>, usize) -> Option<Value>),
    /// From a list and the number in the argument; `None` if a part of this size does not exist.
    Parts(fn(&[Value], usize) -> Option<Vec<Value>>),
    /// From a list and the values of the argument, which is a function, at each element.
    Results(fn(&mut Reader, List, Vec<Value>, &Call) -> Read),
    /// From a list and the last argument, which is a function.
    Function(fn(&mut Reader, Vec<Value>, &Callee, &Call) -> Read),
    /// From the place of a list with this many elements, and the numbers in the arguments.
    Places(fn(&Place, usize, &[usize]) -> Option<Value>),
    /// Changes a list by the arguments.
    Change(fn(&mut Vec<Value>, &[Value])),
    /// Changes a list by the arguments, given as values and as numbers; `None` if they do not fit.
    Edit(Edit),
    /// Takes a value from a list by the numbers in the arguments; `None` if they do not fit.
    Taken(fn(&mut Vec<Value>, &[usize]) -> Option<Value>),
    /// Adds the elements of the argument to a list.
    Extend,
    /// Sorts a list by the argument, which is a function.
    Sort,
    /// From a list, which the rule shortens, and the number in the argument, or 0.
    Next(fn(&mut Vec<Value>, usize) -> Value),
    /// The old value of an `Option`, which gets the argument, or `None`.
    Exchange,
    /// From an iterator without an end, and the first argument.
    Endless(fn(&mut Reader, Endless, Value, &Call) -> Read),
    /// From an iterator without an end, and the number in the first argument.
    EndlessPart(fn(&mut Reader, Endless, usize, &Call) -> Read),
    Holder(fn(&mut Reader, Holder, &Call) -> Read),
    /// True if there is a value in the `Option`, or if there is none.
    IsHeld(bool),
    /// The condition that the argument gives for the value in the `Option`, or else this one.
    HeldAnd(bool),
    /// True for orders with these names.
    IsOrder(&'static [&'static str]),
    /// From the name of an order.
    Order(fn(&mut Reader, &str, &Call) -> Read),
}

impl Method {
    /// Returns the rule for a number of arguments.
    pub fn rule_for(&self, given: usize) -> Option<Rule> {
        (self.takes == ANY || self.takes == given).then_some(self.rule)
    }

    /// Returns how many arguments the method takes, if its rule does not count them.
    pub fn takes(&self) -> Option<usize> {
        (self.takes != ANY).then_some(self.takes)
    }
}

/// Returns the row of a method.
pub fn method(receiver: Receiver, name: &str) -> Option<&'static Method> {
    static ROWS: LazyLock<HashMap<(Receiver, &str), &Method>> = LazyLock::new(|| {
        let keys = |row: &'static Method| {
            row.receivers
                .iter()
                .flat_map(move |of| row.names.iter().map(move |name| ((*of, *name), row)))
        };
        METHODS.iter().flat_map(keys).collect()
    });
    ROWS.get(&(receiver, name)).copied()
}

/// Makes the table from rows `Receiver [names] number of arguments => Rule(…);`.
macro_rules! methods {
    ($($($of:ident)|+ [$($name:literal),+] $takes:tt => $rule:ident $(($how:expr))?;)*) => {
        static METHODS: &[Method] = &[$(Method {
            receivers: &[$(Receiver::$of),+],
            names: &[$($name),+],
            takes: $takes,
            rule: Rule::$rule $(($how))?,
        }),*];
    };
}

methods! {
    // Numbers, under the names of f64.
    Number ["powi"] 1 => Node(|reader, x, call| {
        reader.power(x, call.arguments[0].clone(), call.places[0], call.whole)
    });
    Number ["total_cmp"] 1 => Node(|reader, x, call| {
        let y = reader.scalar(call.arguments[0].clone(), call.places[0]);
        Ok(reader.order_of(x, y))
    });
    Number ["partial_cmp"] 1 => Node(|reader, x, call| {
        let y = reader.scalar(call.arguments[0].clone(), call.places[0]);
        reader.some_order_of(x, y, call)
    });
    Number ["sin_cos"] 0 => Numbers(|g, x| {
        let sin = g.call(Function::Sin, x[0]);
        let cos = g.call(Function::Cos, x[0]);
        Value::Tuple(vec![Value::Scalar(sin), Value::Scalar(cos)])
    });
    Number ["recip"] 0 => Numbers(|g, x| Value::Scalar(g.powi(x[0], -1)));
    Number ["to_radians"] 0 => Numbers(|g, x| {
        let factor = radians(g);
        Value::Scalar(g.mul(factor, x[0]))
    });
    Number ["to_degrees"] 0 => Numbers(|g, x| {
        let factor = degrees(g);
        Value::Scalar(g.mul(factor, x[0]))
    });
    Number ["copysign"] 1 => Numbers(|g, x| {
        let size = g.call(Function::Abs, x[0]);
        let sign = g.call(Function::Signum, x[1]);
        Value::Scalar(g.mul(size, sign))
    });
    Number ["is_nan"] 0 => Numbers(|g, x| class_of(g, "is_nan", x[0]));
    Number ["is_finite"] 0 => Numbers(|g, x| class_of(g, "is_finite", x[0]));
    Number ["is_infinite"] 0 => Numbers(|g, x| class_of(g, "is_infinite", x[0]));
    Number ["is_sign_negative"] 0 => Numbers(|g, x| class_of(g, "is_sign_negative", x[0]));
    Number ["is_sign_positive"] 0 => Numbers(|g, x| class_of(g, "is_sign_positive", x[0]));
    Number ["log"] 1 => Numbers(|g, x| {
        let value = g.call(Function::Ln, x[0]);
        let base = g.call(Function::Ln, x[1]);
        Value::Scalar(g.div(value, base))
    });
    Number ["mul_add"] 2 => Numbers(|g, x| {
        let product = g.mul(x[0], x[1]);
        Value::Scalar(g.add(product, x[2]))
    });
    Number ["clamp"] 2 => Numbers(|g, x| {
        let above = g.call2(Function2::Max, x[0], x[1]);
        Value::Scalar(g.call2(Function2::Min, above, x[2]))
    });
    // Integers.
    Integer ["is_power_of_two"] 0 => OfInteger(|g, k, _| {
        Some(Value::Condition(g.bool(k > 0 && k & (k - 1) == 0)))
    });
    Integer ["is_multiple_of"] 1 => OfInteger(|g, k, n| {
        Some(Value::Condition(g.bool(k == 0 || n != 0 && k % n == 0)))
    });
    Integer ["count_ones"] 0 => OfInteger(|_, k, _| {
        (k >= 0).then(|| Value::Integer(i64::from(k.count_ones()), IntegerType::named("u32")))
    });
    Integer ["trailing_zeros"] 0 => OfInteger(|_, k, _| {
        (k > 0)
            .then(|| Value::Integer(i64::from(k.trailing_zeros()), IntegerType::named("u32")))
    });
    Integer ["div_ceil"] 1 => Integer(|k, n, _| {
        (k >= 0 && n > 0).then(|| (k - 1).div_euclid(n) + 1)
    });
    Integer ["saturating_sub"] 1 => Integer(|k, n, ty| ty?.is_unsigned().then(|| (k - n).max(0)));
    Integer ["pow"] 1 => Integer(|k, n, _| u32::try_from(n).ok().and_then(|n| k.checked_pow(n)));
    Integer ["abs"] 0 => Integer(|k, _, _| k.checked_abs());
    Integer ["signum"] 0 => Integer(|k, _, _| Some(k.signum()));
    Integer ["rem_euclid"] 1 => Integer(|k, n, _| k.checked_rem_euclid(n));
    Integer ["div_euclid"] 1 => Integer(|k, n, _| k.checked_div_euclid(n));
    Integer ["min"] 1 => Integer(|k, n, _| Some(k.min(n)));
    Integer ["max"] 1 => Integer(|k, n, _| Some(k.max(n)));
    Integer ["abs_diff"] 1 => Integer(|k, n, _| k.checked_sub(n).and_then(i64::checked_abs));
    // Conditions.
    Condition ["then"] 1 => Node(|reader, holds, call| reader.some_where(holds, call));
    Condition ["then_some"] 1 => Node(|reader, holds, call| {
        reader.joined(holds, &Value::some(call.arguments[0].clone()), &Value::none(), call)
    });
    Condition ["not"] 0 => Node(|reader, holds, _| Ok(Value::Condition(reader.graph.not(holds))));
    Condition ["cmp", "eq", "ne"] ANY => Node(|_, _, call| {
        Err(call.unreadable(format!("`{}` of a condition", call.name)))
    });
    // Vectors, matrices and Euler parameters, under the names of nalgebra.
    Vector2 | Vector3 | Euler ["norm"] 0 => Alone(|values, _, v| Value::Scalar(values.norm(v)));
    Vector2 | Vector3 | Euler ["norm_squared"] 0 => Alone(|values, _, v| {
        Value::Scalar(values.dot(v, v))
    });
    Vector2 | Vector3 | Euler ["normalize"] 0 => Alone(|values, kind, v| {
        kind.value(values.normalized(v))
    });
    Vector2 | Vector3 | Euler ["to_array"] 0 => Alone(|_, _, v| lists::numbers(v));
    Vector2 | Vector3 | Euler ["dot"] 1 => Pair(|values, _, v, w| Value::Scalar(values.dot(v, w)));
    Vector2 | Vector3 | Euler ["component_mul"] 1 => Pair(|values, kind, v, w| {
        kind.value(values.component_by_component(v, w, Graph::mul))
    });
    Vector2 | Vector3 | Euler ["component_div"] 1 => Pair(|values, kind, v, w| {
        kind.value(values.component_by_component(v, w, Graph::div))
    });
    Vector2 | Vector3 | Euler ["lerp"] 2 => Components(|reader, kind, v, call| {
        let w = reader.other(kind, call);
        let t = reader.scalar(call.arguments[1].clone(), call.places[1]);
        Ok(kind.value(reader.lerp(v, &w, t)))
    });
    Vector2 | Vector3 | Matrix | Euler ["map"] 1 => Components(Reader::mapped);
    Vector2 ["perp"] 0 => Alone(|values, kind, v| kind.value(vec![values.graph.neg(v[1]), v[0]]));
    Vector2 | Vector3 ["cross"] 1 => Pair(|values, _, v, w| values.cross(v, w));
    Vector3 ["axis"] 0 => Components(Reader::axis_of);
    Vector3 ["axis_near"] 1 => Components(Reader::axis_of);
    Euler ["vector"] 0 => Alone(|_, _, p| Value::Vector(p[1..].to_vec()));
    Euler ["conjugate"] 0 => Alone(|values, kind, p| {
        let opposite = p[1..].iter().map(|&n| values.graph.neg(n));
        kind.value(std::iter::once(p[0]).chain(opposite).collect())
    });
    Euler ["rotation"] 0 => Alone(|values, _, p| Value::Matrix(3, values.rotation_of(p)));
    Euler ["product"] 1 => Pair(|values, kind, p, q| kind.value(values.euler_product(p, q)));
    Matrix ["transpose"] 0 => Alone(|_, kind, m| kind.value(transpose(m)));
    Matrix ["to_array"] 0 => Alone(|_, kind, m| {
        Value::Array(m.chunks(kind.side()).map(lists::numbers).collect())
    });
    Matrix ["trace"] 0 => Alone(|values, kind, m| Value::Scalar(values.trace(kind.side(), m)));
    Matrix ["determinant"] 0 => Alone(|values, _, m| Value::Scalar(values.determinant(m)));
    Matrix ["column", "row"] 1 => Components(|reader, kind, m, call| {
        reader.row_or_column(kind.side(), m, call)
    });
    // States of bodies, and laws.
    Body ["a"] 0 => Body(|reader, body, _| {
        Ok(Value::Matrix(body.dimension, reader.rotation(body.slot, body.dimension)))
    });
    Body ["point"] 1 => Body(|reader, body, call| {
        let u = reader.of_dimension(body.dimension, call);
        reader.attach(body.slot, true, &u);
        Ok(Value::Vector(reader.point(body.slot, &u)))
    });
    Body ["direction"] 1 => Body(|reader, body, call| {
        let h = reader.of_dimension(body.dimension, call);
        reader.attach(body.slot, false, &h);
        Ok(Value::Vector(reader.direction(body.slot, &h)))
    });
    Body ["local"] 1 => Body(|reader, body, call| {
        let p = reader.of_dimension(body.dimension, call);
        Ok(Value::Vector(reader.local(body.slot, &p)))
    });
    Law ["at"] 1 => Law(0);
    Law ["slope"] 1 => Law(1);
    // Arrays, and iterators over a known list of values.
    List ["len"] 0 => Elements(|_, all| Value::count(all.len()));
    List ["is_empty"] 0 => Elements(|values, all| values.truth(all.is_empty()));
    List ["iter"] 0 => Elements(|_, all| Value::Iterator(all.into_iter().map(borrowed).collect()));
    List ["into_iter"] 0 => Elements(|_, all| Value::Iterator(all));
    List ["copied", "cloned"] 0 => Elements(|values, all| {
        Value::Iterator(all.into_iter().map(|value| values.loaded(value)).collect())
    });
    List ["rev"] 0 => Elements(|_, all| Value::Iterator(all.into_iter().rev().collect()));
    List ["enumerate"] 0 => Elements(|_, all| {
        lists::pairs((0..all.len()).map(Value::count).collect(), all)
    });
    List ["collect"] 0 => Elements(|values, all| values.array_of(all));
    List ["to_vec", "as_slice", "into_boxed_slice"] 0 => List(|reader, list, _| {
        match list.is_array {
            true => Ok(reader.array_of(list.all)),
            false => Ok(Value::Iterator(list.all)),
        }
    });
    List ["by_ref", "fuse", "peekable"] 0 => List(|_, list, call| match list.is_array {
        true => Err(call.not_of_a_list()),
        false => Ok(Value::Iterator(list.all)),
    });
    List ["concat"] 0 => List(|reader, list, call| {
        reader.flattened(list.all, call).map(Value::Array)
    });
    List ["flatten"] 0 => List(|reader, list, call| {
        reader.flattened(list.all, call).map(Value::Iterator)
    });
    List ["sum"] 0 => List(|reader, list, call| reader.folded(list.all, true, call));
    List ["product"] 0 => List(|reader, list, call| reader.folded(list.all, false, call));
    List ["fold"] 2 => List(|reader, list, call| {
        let f = reader.function(call.arguments[1].clone(), call.places[1])?;
        let mut each = list.all.into_iter();
        each.try_fold(call.arguments[0].clone(), |sum, value| {
            reader.apply(&f, vec![sum, value], &[], call)
        })
    });
    List ["zip"] 1 => List(|reader, list, call| reader.zipped_lists(list.all, call));
    List ["chain"] 1 => List(|reader, list, call| {
        let other = reader.elements(call.arguments[0].clone(), call.places[0])?;
        Ok(other.map_or(Value::Poison, |other| Value::Iterator([list.all, other].concat())))
    });
    List ["contains"] 1 => List(|reader, list, call| {
        reader.contains(list.all, call.arguments[0].clone().referent(), call)
    });
    List ["unzip"] ANY => List(|reader, list, call| {
        lists::count_in(call)?;
        reader.unzipped(list.all, call)
    });
    List ["cycle"] ANY => Picked(|all, _| {
        (!all.is_empty()).then(|| Value::Endless(Endless::Cycle(all)))
    });
    List ["first"] ANY => Picked(|all, _| Some(option(all.into_iter().next().map(borrowed))));
    List ["next"] ANY => Picked(|all, _| Some(option(all.into_iter().next())));
    List ["last"] ANY => Picked(|all, _| Some(option(all.into_iter().next_back())));
    List ["nth"] ANY => Picked(|all, k| Some(option(all.into_iter().nth(k))));
    List ["get"] ANY => Picked(|all, k| Some(option(all.into_iter().nth(k).map(borrowed))));
    List ["count"] ANY => Picked(|all, _| Some(Value::count(all.len())));
    List ["split_at"] ANY => Picked(|mut all, k| {
        (k <= all.len()).then(|| {
            let rest = all.split_off(k);
            Value::Tuple(vec![Value::Array(all), Value::Array(rest)])
        })
    });
    List ["split_first"] ANY => Picked(|all, _| {
        let mut rest = all.into_iter();
        let first = rest.next();
        let pair = |first| Value::Tuple(vec![borrowed(first), Value::Array(rest.collect())]);
        Some(option(first.map(pair)))
    });
    List ["split_last"] ANY => Picked(|mut all, _| {
        let last = all.pop();
        Some(option(last.map(|last| Value::Tuple(vec![borrowed(last), Value::Array(all)]))))
    });
    // The conversion into an array keeps the length, which rustc compares with the declared one.
    List ["try_into"] ANY => Picked(|all, _| {
        Some(Value::Adt(Adt::new("Ok", Some(Value::Array(all)))))
    });
    List ["skip"] 1 => Parts(|all, k| Some(all.iter().skip(k).cloned().collect()));
    List ["take"] 1 => Parts(|all, k| Some(all.iter().take(k).cloned().collect()));
    List ["step_by"] 1 => Parts(|all, k| (k > 0).then(|| all.iter().step_by(k).cloned().collect()));
    List ["windows"] 1 => Parts(|all, k| {
        (k > 0).then(|| all.windows(k).map(lists::array).collect())
    });
    List ["chunks"] 1 => Parts(|all, k| (k > 0).then(|| all.chunks(k).map(lists::array).collect()));
    List ["chunks_exact"] 1 => Parts(|all, k| {
        (k > 0).then(|| all.chunks_exact(k).map(lists::array).collect())
    });
    List ["map"] 1 => Results(|_, list, results, _| match list.is_array {
        true => Ok(Value::Array(results)),
        false => Ok(Value::Iterator(results)),
    });
    List ["flat_map"] 1 => Results(|reader, _, results, call| {
        reader.flattened(results, call).map(Value::Iterator)
    });
    List ["filter"] 1 => Results(|reader, list, results, call| {
        let conditions = reader.conditions_of(results, call);
        reader.filtered(&list.all, &conditions, call)
    });
    List ["partition"] 1 => Results(|reader, list, results, call| {
        let conditions = reader.conditions_of(results, call);
        reader.partitioned(&list.all, conditions, call)
    });
    List ["filter_map"] 1 => Results(|reader, _, results, call| reader.kept_values(results, call));
    List ["find_map"] 1 => Results(|reader, _, results, call| reader.first_value(results, call));
    List ["any"] 1 => Results(|reader, _, results, call| {
        let none = reader.graph.bool(false);
        reader.folded_conditions(none, results, Graph::or, call)
    });
    List ["all"] 1 => Results(|reader, _, results, call| {
        let always = reader.graph.bool(true);
        reader.folded_conditions(always, results, Graph::and, call)
    });
    List ["for_each"] ANY => Function(|reader, all, f, call| {
        all.into_iter()
            .try_for_each(|value| reader.apply(f, vec![value], &[], call).map(drop))?;
        Ok(Value::unit())
    });
    List ["reduce"] ANY => Function(|reader, all, f, call| {
        let mut all = all.into_iter();
        let Some(first) = all.next() else { return Ok(Value::none()) };
        all.try_fold(first, |sum, value| reader.apply(f, vec![sum, value], &[], call))
            .map(Value::some)
    });
    List ["min_by"] ANY => Function(|reader, all, f, call| {
        reader.best_of(all, f, call, |best, value| [value, best])
    });
    List ["max_by"] ANY => Function(|reader, all, f, call| {
        reader.best_of(all, f, call, |best, value| [best, value])
    });
    List ["scan"] ANY => Function(Reader::scanned);
    List ["position"] ANY => Function(|reader, all, f, call| {
        let conditions = reader.holds_for(&all, f, call, Value::clone)?;
        let counts: Vec<Value> = (0..all.len()).map(Value::count).collect();
        reader.first_of(&counts, &conditions, call)
    });
    List ["find"] ANY => Function(|reader, all, f, call| {
        let conditions = reader.holds_for(&all, f, call, lists::reference)?;
        reader.first_of(&all, &conditions, call)
    });
    List ["partition_point"] ANY => Function(|reader, all, f, call| {
        let conditions = reader.holds_for(&all, f, call, lists::reference)?;
        reader.count_before(&conditions, call)
    });
    List ["take_while"] ANY => Function(|reader, all, f, call| {
        let conditions = reader.holds_for(&all, f, call, lists::reference)?;
        let cuts: Vec<Value> = (0..all.len()).map(|k| lists::iterator(&all[..k])).collect();
        reader.cut(lists::iterator(&all), &cuts, &conditions, call)
    });
    List ["skip_while"] ANY => Function(|reader, all, f, call| {
        let conditions = reader.holds_for(&all, f, call, lists::reference)?;
        let cuts: Vec<Value> = (0..all.len()).map(|k| lists::iterator(&all[k..])).collect();
        reader.cut(Value::Iterator(vec![]), &cuts, &conditions, call)
    });
    List ["map_while"] ANY => Function(Reader::mapped_while);
    // Changes of a variable that holds an array.
    ListVariable ["iter_mut"] 0 => Places(|place, n, _| {
        Some(Value::Iterator((0..n).map(|k| Value::Place(place.index(k))).collect()))
    });
    ListVariable ["first_mut"] 0 => Places(|place, n, _| Some(lists::place_of(place, n, Some(0))));
    ListVariable ["last_mut"] 0 => Places(|place, n, _| {
        Some(lists::place_of(place, n, n.checked_sub(1)))
    });
    ListVariable ["get_mut"] 1 => Places(|place, n, counts| {
        (counts.len() == 1).then(|| lists::place_of(place, n, Some(counts[0])))
    });
    ListVariable ["split_at_mut"] 1 => Places(|place, n, counts| match counts {
        &[k] if k <= n => Some(Value::Tuple(lists::slices(place, &[(0, k), (k, n)]))),
        _ => None,
    });
    ListVariable ["chunks_mut"] 1 => Places(|place, n, counts| {
        lists::chunks(place, n, *counts.first()?).map(Value::Iterator)
    });
    ListVariable ["chunks_exact_mut"] 1 => Places(|place, n, counts| {
        let k = *counts.first()?;
        lists::chunks(place, n - n.checked_rem(k)?, k).map(Value::Iterator)
    });
    ListVariable ["reverse"] 0 => Change(|all, _| all.reverse());
    ListVariable ["fill"] 1 => Change(|all, given| all.fill(given[0].clone()));
    ListVariable ["push"] 1 => Change(|all, given| all.push(given[0].clone()));
    ListVariable ["clear"] 0 => Change(|all, _| all.clear());
    ListVariable ["pop"] 0 => Taken(|all, _| Some(option(all.pop())));
    ListVariable ["remove"] 1 => Taken(|all, counts| match counts {
        &[k] if k < all.len() => Some(all.remove(k)),
        _ => None,
    });
    ListVariable ["swap"] 2 => Edit(|all, _, counts| match counts {
        &[a, b] => (a < all.len() && b < all.len()).then(|| all.swap(a, b)),
        _ => None,
    });
    ListVariable ["insert"] 2 => Edit(|all, given, counts| match counts {
        &[k, ..] => (k <= all.len()).then(|| all.insert(k, given[1].clone())),
        _ => None,
    });
    ListVariable ["truncate"] 1 => Edit(|all, _, counts| counts.first().map(|&k| all.truncate(k)));
    ListVariable ["copy_from_slice", "clone_from_slice"] 1 => Edit(|all, given, _| {
        let Value::Array(more) = &given[0] else { return None };
        (more.len() == all.len()).then(|| all.clone_from(more))
    });
    ListVariable ["rotate_left"] 1 => Edit(|all, _, counts| match counts {
        &[k] => (k <= all.len()).then(|| all.rotate_left(k)),
        _ => None,
    });
    ListVariable ["rotate_right"] 1 => Edit(|all, _, counts| match counts {
        &[k] => (k <= all.len()).then(|| all.rotate_right(k)),
        _ => None,
    });
    ListVariable ["extend", "extend_from_slice"] 1 => Extend;
    ListVariable ["sort_by", "sort_unstable_by"] 1 => Sort;
    // Changes of a variable that holds an iterator or an `Option`.
    IteratorVariable ["peek"] 0 => Next(|all, _| option(all.first().map(lists::reference)));
    IteratorVariable ["next"] 0 => Next(|all, _| {
        option(all.drain(..all.len().min(1)).next())
    });
    IteratorVariable ["nth"] 1 => Next(|all, k| {
        option(all.drain(..all.len().min(k + 1)).nth(k))
    });
    IteratorVariable ["next_back"] 0 => Next(|all, _| option(all.pop()));
    HolderVariable ["take"] 0 => Exchange;
    HolderVariable ["replace"] 1 => Exchange;
    // Iterators without an end.
    Endless ["copied", "cloned", "fuse", "by_ref", "into_iter"] 0 => Endless(|_, endless, _, _| {
        Ok(Value::Endless(endless))
    });
    Endless ["map"] 1 => Endless(|reader, endless, f, call| {
        let f = reader.function(f, call.places[0])?;
        Ok(Value::Endless(Endless::Mapped(Rc::new(endless), f)))
    });
    Endless ["take"] 1 => EndlessPart(|reader, endless, k, call| {
        reader.first_of_endless(&endless, k, call.whole).map(Value::Iterator)
    });
    Endless ["skip"] 1 => EndlessPart(|_, endless, k, _| {
        Ok(Value::Endless(Endless::Skipped(Rc::new(endless), k)))
    });
    Endless ["step_by"] 1 => EndlessPart(|_, endless, k, call| match k {
        0 => Err(Unreadable::new(call.places[0], "a step of zero")),
        _ => Ok(Value::Endless(Endless::Stepped(Rc::new(endless), k))),
    });
    Endless ["zip"] 1 => Endless(|reader, endless, other, call| {
        let Some(other) = reader.elements(other, call.places[0])? else {
            return Ok(Value::Poison);
        };
        let own = reader.first_of_endless(&endless, other.len(), call.whole)?;
        Ok(lists::pairs(own, other))
    });
    Endless ["take_while"] 1 => Endless(|reader, endless, f, call| {
        let f = reader.function(f, call.places[0])?;
        reader.taken_while(&endless, &f, call.whole).map(Value::Iterator)
    });
    // `Option` and `Result`.
    Holder ["is_some", "is_ok"] 0 => IsHeld(true);
    Holder ["is_none", "is_err"] 0 => IsHeld(false);
    Holder ["unwrap", "expect"] ANY => Holder(|_, holder, call| {
        Ok(holder.held().filter(|_| call.arguments.len() <= 1).unwrap_or(Value::Never))
    });
    Holder ["unwrap_or_default"] ANY => Holder(|reader, holder, call| {
        match (holder.held(), call.arguments.len()) {
            (Some(inner), 0 | 1) => Ok(inner),
            (None, 0) => Ok(Value::Scalar(reader.graph.zero())),
            _ => reader.no_such_holder_method(call),
        }
    });
    Holder ["unwrap_or"] 1 => Holder(|_, holder, call| {
        Ok(holder.held().unwrap_or_else(|| call.arguments[0].clone()))
    });
    Holder ["unwrap_or_else"] 1 => Holder(|reader, holder, call| match holder.held() {
        Some(inner) => Ok(inner),
        None => reader.applied(0, holder.error(), call),
    });
    Holder ["map"] 1 => Holder(|reader, holder, call| match holder.held() {
        Some(inner) => Ok(holder.with(reader.applied(0, vec![inner], call)?)),
        None => Ok(holder.same()),
    });
    Holder ["and_then"] 1 => Holder(|reader, holder, call| match holder.held() {
        Some(inner) => reader.applied(0, vec![inner], call),
        None => Ok(holder.same()),
    });
    Holder ["filter"] 1 => Holder(|reader, holder, call| {
        let Some(inner) = holder.held() else { return Ok(holder.same()) };
        let keeps = reader.applied(0, vec![borrowed(inner)], call)?;
        let keeps = reader.condition(keeps, call);
        reader.joined(keeps, &holder.same(), &Value::none(), call)
    });
    Holder ["map_or"] 2 => Holder(|reader, holder, call| match holder.held() {
        Some(inner) => reader.applied(1, vec![inner], call),
        None => Ok(call.arguments[0].clone()),
    });
    Holder ["map_or_else"] 2 => Holder(|reader, holder, call| match holder.held() {
        Some(inner) => reader.applied(1, vec![inner], call),
        None => reader.applied(0, holder.error(), call),
    });
    Holder ["is_some_and", "is_ok_and"] 1 => HeldAnd(false);
    Holder ["is_none_or"] 1 => HeldAnd(true);
    Holder ["or"] 1 => Holder(|_, holder, call| {
        Ok(if holder.is_held() { holder.same() } else { call.arguments[0].clone() })
    });
    Holder ["or_else"] 1 => Holder(|reader, holder, call| match holder.is_held() {
        true => Ok(holder.same()),
        false => reader.applied(0, vec![], call),
    });
    Holder ["and"] 1 => Holder(|_, holder, call| {
        Ok(if holder.is_held() { call.arguments[0].clone() } else { holder.same() })
    });
    Holder ["ok"] ANY => Holder(|_, holder, call| {
        call.takes(0)?;
        Ok(holder.held().map_or(Value::none(), Value::some))
    });
    Holder ["err"] ANY => Holder(|_, holder, call| {
        call.takes(0)?;
        Ok(if holder.is_held() { Value::none() } else { variant("Some", holder.inner()) })
    });
    Holder ["ok_or"] ANY => Holder(|_, holder, call| {
        call.takes(1)?;
        Ok(holder.ok().unwrap_or_else(|| variant("Err", Some(call.arguments[0].clone()))))
    });
    Holder ["ok_or_else"] ANY => Holder(|reader, holder, call| {
        call.takes(1)?;
        match holder.ok() {
            Some(ok) => Ok(ok),
            None => Ok(variant("Err", Some(reader.applied(0, vec![], call)?))),
        }
    });
    Holder ["map_err"] ANY => Holder(|reader, holder, call| {
        call.takes(1)?;
        match holder.is_held() {
            true => Ok(holder.same()),
            false => {
                let error = reader.applied(0, holder.inner().into_iter().collect(), call)?;
                Ok(variant("Err", Some(error)))
            }
        }
    });
    Holder ["copied", "cloned", "as_ref", "as_mut", "clone", "as_deref", "take"] 0 =>
        Holder(|reader, holder, _| {
            let inner = holder.held().map(|inner| reader.loaded(inner));
            Ok(inner.map_or_else(|| holder.same(), |inner| holder.with(inner)))
        });
    Holder ["zip"] 1 => Holder(|reader, holder, call| {
        reader.zipped(&holder.same(), call.arguments[0].clone(), call)
    });
    Holder ["iter", "into_iter"] 0 => Holder(|_, holder, _| {
        Ok(Value::Iterator(holder.held().into_iter().collect()))
    });
    Holder ["flatten"] 0 => Holder(|reader, holder, _| {
        Ok(holder.held().map_or_else(|| holder.same(), |inner| reader.loaded(inner)))
    });
    // `Ordering`.
    Order ["is_lt"] ANY => IsOrder(&["Less"]);
    Order ["is_le"] ANY => IsOrder(&["Less", "Equal"]);
    Order ["is_gt"] ANY => IsOrder(&["Greater"]);
    Order ["is_ge"] ANY => IsOrder(&["Greater", "Equal"]);
    Order ["is_eq"] ANY => IsOrder(&["Equal"]);
    Order ["is_ne"] ANY => IsOrder(&["Less", "Greater"]);
    Order ["reverse"] ANY => Order(|_, order, _| {
        Ok(order_named(match order {
            "Less" => "Greater",
            "Greater" => "Less",
            _ => "Equal",
        }))
    });
    Order ["then"] ANY => Order(|_, order, call| match &call.arguments[..] {
        [other] if order == "Equal" => Ok(other.clone()),
        _ => Ok(order_named(order)),
    });
    Order ["then_with"] ANY => Order(|reader, order, call| match call.arguments.len() {
        1 if order == "Equal" => reader.applied(0, vec![], call),
        _ => Ok(order_named(order)),
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vocabulary::{is_number_method, is_scalar_method};

    #[test]
    fn a_receiver_has_one_row_for_a_name() {
        let mut known = std::collections::HashSet::new();
        for row in METHODS {
            for key in
                row.receivers.iter().flat_map(|of| row.names.iter().map(move |name| (*of, *name)))
            {
                assert!(known.insert(key), "two rows for {key:?}");
            }
        }
        assert!(known.len() > 150);
    }

    /// The rewriter of bodies knows methods by their names alone.
    #[test]
    fn the_vocabulary_has_the_methods_of_numbers() {
        for row in METHODS {
            for name in row.names {
                if row.receivers.contains(&Receiver::Number) {
                    assert!(is_scalar_method(name), "{name}");
                }
                if matches!(row.rule, Rule::Alone(_) | Rule::Pair(_) | Rule::Law(_)) {
                    assert!(is_number_method(name), "{name}");
                }
            }
        }
    }

    #[test]
    fn a_rule_needs_its_number_of_arguments() {
        let clamp = method(Receiver::Number, "clamp").expect("a method of numbers");
        assert!(clamp.rule_for(2).is_some() && clamp.rule_for(1).is_none());
        assert!(method(Receiver::Vector3, "perp").is_none());
        assert!(method(Receiver::Vector2, "perp").is_some());
    }
}
