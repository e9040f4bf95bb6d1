/* @title@: positions, velocities and accelerations by the values of the drivers.
 *
 * Printed by Kin @version@. The file needs a C99 compiler and <math.h>, and nothing else.
 *
 *     @N@_state s;
@usage_start@
 *     code = @N@_to(&s, u);        the position at the values u of the drivers, near the last one
 *     code = @N@_rates(&s, ud, udd, qd, qdd);
 *
 * @N@_to takes the way from the last position to u in one step. If the step is too long to be sure
 * of the branch, or leads to a singular position, @N@_to returns a code and does not change s.
 * @N@_selftest() returns 0 if this file computes on this machine what it must.
 *
@comment@
 */
#include <math.h>

enum {
    @N@_DRIVERS = @drivers@,
    @N@_COORDINATES = @coordinates@,
    @N@_MEASURES = @measures@
};

enum {
    @N@_OK = 0,
    @N@_NOT_FINITE = 1,
    @N@_TOO_FAR = 2,
    @N@_SINGULAR = 3,
    @N@_TURNED = 4,
    @N@_NOT_CONVERGED = 5,
    @N@_NOT_SATISFIED = 6
};

@types@typedef struct {
    double u[@N@_DRIVERS];     /* the values of the drivers */
    double q[@N@_COORDINATES]; /* the coordinates there */
@state_fields@} @N@_state;

const char *@N@_text(int code);
int @N@_start(@start_arguments@);
int @N@_to(@N@_state *s, const double u[]);
int @N@_rates(const @N@_state *s, const double ud[], const double udd[], double qd[], double qdd[]);
@prototypes@int @N@_selftest(void);

/* The numbers of one position, in the order of their computation. */
struct @N@_work {
    double p[@p@];   /* numbers that depend on free dimensions */
    double u[@N@_DRIVERS], ud[@N@_DRIVERS], udd[@N@_DRIVERS];
    double y[@y@];   /* the coordinates that Newton's method computes */
    double w[@w@];   /* numbers that a later function reads */
    double dy[@y@];  /* the correction of y */
    double left[@left@]; /* the equations that remain, with opposite sign */
    double q[@N@_COORDINATES], dq[@N@_COORDINATES];
    double qd[@N@_COORDINATES], qdd[@N@_COORDINATES];
    double c[@c@];   /* every equation as written */
    double g[@g@];   /* pivots and determinants */
};

@helpers@@stages@/* The characteristic size of each coordinate. */
static const double @N@_size[@N@_COORDINATES] = {@sizes@};
/* 1 for an angle, 0 for a length. */
static const unsigned char @N@_turns[@N@_COORDINATES] = {@turns@};
/* How far an equation may be off. */
static const double @N@_allowed[@c@] = {@allowed@};
/* Pivots and determinants at the start. */
static const double @N@_mark[@g@] = {@marks@};
/* The number of pivots and determinants of each block. */
static const int @N@_block[@blocks@] = {@block_sizes@};
/* The position at the start. */
static const double @N@_u0[@N@_DRIVERS] = {@u0@};
static const double @N@_q0[@N@_COORDINATES] = {@q0@};
@torn_tables@
const char *@N@_text(int code)
{
    switch (code) {
    case @N@_OK:
        return "the position was reached";
    case @N@_NOT_FINITE:
        return "a number is not finite";
    case @N@_TOO_FAR:
        return "the step is too long: move the drivers in smaller steps";
    case @N@_SINGULAR:
        return "the step leads to a singular position, such as a toggle, or too near to one";
    case @N@_TURNED:
        return "the step leads across a singular position, to another branch";
    case @N@_NOT_CONVERGED:
        return "Newton's method does not converge: the position may not exist";
    case @N@_NOT_SATISFIED:
        return "an equation is not satisfied";
    default:
        return "unknown code";
    }
}

/* All functions of one position without iteration. */
static void @N@_evaluate(struct @N@_work *k)
{
@calls@
}

static int @N@_is_finite(const double x[], int n)
{
    int i;
    for (i = 0; i < n; i++) {
        if (!isfinite(x[i])) {
            return 0;
        }
    }
    return 1;
}

/* Newton's method at the values k->u of the drivers, from k->y. */
static int @N@_newton(struct @N@_work *k)
{
@newton@
}

/* The checks of a position on its own. */
static int @N@_check(const struct @N@_work *k)
{
    int i;
    if (!@N@_is_finite(k->q, @N@_COORDINATES) || !@N@_is_finite(k->qd, @N@_COORDINATES)
        || !@N@_is_finite(k->qdd, @N@_COORDINATES)) {
        return @N@_NOT_FINITE;
    }
    for (i = 0; i < @c_count@; i++) {
        if (!(fabs(k->c[i]) <= @N@_allowed[i])) {
            return @N@_NOT_SATISFIED;
        }
    }
    for (i = 0; i < @g_count@; i++) {
        if (!(fabs(k->g[i]) >= 1e-4 * fabs(@N@_mark[i]))) {
            return @N@_SINGULAR;
        }
    }
    return @N@_OK;
}

/* Returns TURNED if a block of equations has another orientation, SINGULAR if a pivot is lost. */
static int @N@_compare(const double before[], const double now[])
{
    int block, i, k = 0;
    for (block = 0; block < @block_count@; block++) {
        double product = 1.0;
        for (i = 0; i < @N@_block[block]; i++, k++) {
            const double share = now[k] / before[k];
            if (!(fabs(share) >= 0.02)) {
                return @N@_SINGULAR;
            }
            product *= share > 0.0 ? 1.0 : -1.0;
        }
        if (product < 0.0) {
            return @N@_TURNED;
        }
    }
    return @N@_OK;
}

static void @N@_load(const @N@_state *s, struct @N@_work *k)
{
@load@
}

int @N@_to(@N@_state *s, const double u[])
{
    struct @N@_work k;
    double v[@N@_COORDINATES], a[@N@_COORDINATES], g[@g@] = {0.0};
    double miss = 0.0, reach = 0.0, pivot = 1.0;
    int i, code;
    if (!@N@_is_finite(u, @N@_DRIVERS)) {
        return @N@_NOT_FINITE;
    }
    /* The velocities of a straight way that takes the time 1. */
    @N@_load(s, &k);
    for (i = 0; i < @N@_DRIVERS; i++) {
        k.ud[i] = u[i] - s->u[i];
        k.udd[i] = 0.0;
    }
    @N@_evaluate(&k);
    for (i = 0; i < @N@_COORDINATES; i++) {
        v[i] = k.qd[i];
        a[i] = k.qdd[i];
    }
    for (i = 0; i < @g_count@; i++) {
        g[i] = k.g[i];
    }
    /* The position that they predict at its end, and the one near it. */
    for (i = 0; i < @N@_DRIVERS; i++) {
        k.u[i] = u[i];
    }
@predict@
    code = @N@_newton(&k);
    if (code == @N@_OK) {
        code = @N@_check(&k);
    }
    if (code == @N@_OK) {
        code = @N@_compare(g, k.g);
    }
    if (code != @N@_OK) {
        return code;
    }
    /* From each end the other one must be near its prediction. */
    for (i = 0; i < @N@_COORDINATES; i++) {
        const double way = k.q[i] - s->q[i];
        const double ahead = fabs(way - (v[i] + 0.5 * a[i])) / @N@_size[i];
        const double back = fabs(way - (k.qd[i] - 0.5 * k.qdd[i])) / @N@_size[i];
        miss = ahead > miss ? ahead : miss;
        miss = back > miss ? back : miss;
        if (@N@_turns[i] && fabs(way) > reach) {
            reach = fabs(way);
        }
    }
    for (i = 0; i < @g_count@; i++) {
        pivot = fmin(pivot, fmin(fabs(g[i]), fabs(k.g[i])) / fabs(@N@_mark[i]));
    }
    if (@is_checked@ && (!(miss <= 0.05 * @pivot@ * pivot) || reach > 1.0)) {
        return @N@_TOO_FAR;
    }
    for (i = 0; i < @N@_DRIVERS; i++) {
        s->u[i] = u[i];
    }
    for (i = 0; i < @N@_COORDINATES; i++) {
        s->q[i] = k.q[i];
    }
    return @N@_OK;
}

int @N@_rates(const @N@_state *s, const double ud[], const double udd[], double qd[], double qdd[])
{
    struct @N@_work k;
    int i;
    @N@_load(s, &k);
    for (i = 0; i < @N@_DRIVERS; i++) {
        k.ud[i] = ud[i];
        k.udd[i] = udd[i];
    }
    @N@_evaluate(&k);
    if (!@N@_is_finite(k.qd, @N@_COORDINATES) || !@N@_is_finite(k.qdd, @N@_COORDINATES)) {
        return @N@_NOT_FINITE;
    }
    for (i = 0; i < @N@_COORDINATES; i++) {
        qd[i] = k.qd[i];
        qdd[i] = k.qdd[i];
    }
    return @N@_OK;
}

@more@@start@
/* Returns 1 if two lists agree within rounding. */
static int @N@_agree(const double x[], const double y[], int n, double tolerance)
{
    double most = 1.0;
    int i;
    for (i = 0; i < n; i++) {
        most = fmax(most, fabs(y[i]));
    }
    for (i = 0; i < n; i++) {
        if (!(fabs(x[i] - y[i]) <= tolerance * most)) {
            return 0;
        }
    }
    return 1;
}

int @N@_selftest(void)
{
@selftest@
}
