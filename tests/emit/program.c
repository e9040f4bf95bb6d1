/* Runs an emitted file: see programs.rs. */
#include <stdio.h>
#include <string.h>

#include "emitted.c"

#define JOINED(a, b) a##b
#define NAMED(a, b) JOINED(a, b)
#define OF(b) NAMED(PREFIX, b)

#ifndef CHANGE
#define CHANGE
#endif

#ifdef FREE
static int start(OF(_state) *s)
{
    OF(_dimensions) d = OF(_nominal);
    CHANGE;
    return OF(_start)(s, &d);
}
#else
static int start(OF(_state) *s)
{
    return OF(_start)(s);
}
#endif

enum { D = OF(_DRIVERS), N = OF(_COORDINATES) };

/* Moves to u, in shorter steps where one is too long. */
static int move(OF(_state) *s, const double u[])
{
    double share = 1.0, done = 0.0, from[D], way[D];
    int i, code, halves = 0;
    for (i = 0; i < D; i++) {
        from[i] = s->u[i];
    }
    while (done < 1.0) {
        const double next = done + share < 1.0 ? done + share : 1.0;
        for (i = 0; i < D; i++) {
            way[i] = next < 1.0 ? from[i] + next * (u[i] - from[i]) : u[i];
        }
        code = OF(_to)(s, way);
        if (code == OF(_OK)) {
            done = next;
        } else if (halves < 30) {
            halves++;
            share *= 0.5;
        } else {
            return code;
        }
    }
    return OF(_OK);
}

static void print(const double q[], const double qd[], const double qdd[])
{
    int i;
    for (i = 0; i < 3 * N; i++) {
        printf(" %.17g", i < N ? q[i] : i < 2 * N ? qd[i - N] : qdd[i - 2 * N]);
    }
    printf("\n");
}

int main(int argc, char **argv)
{
    static OF(_state) s;
    double u[D], ud[D], udd[D], qd[N] = {0.0}, qdd[N] = {0.0};
    int i, code, single;
    if (argc > 1 && strcmp(argv[1], "selftest") == 0) {
        printf("%d\n", OF(_selftest)());
        return 0;
    }
    code = start(&s);
    if (code != OF(_OK)) {
        fprintf(stderr, "%s\n", OF(_text)(code));
        return 1;
    }
#ifdef TIMED
    while (argc > 1 && strcmp(argv[1], "time") == 0 && scanf("%lf", u) == 1) {
        code = OF(_at)(&s, u[0]);
        printf("%d", code == OF(_OK) ? OF(_rates_at)(&s, u[0], qd, qdd) : code);
        print(s.q, qd, qdd);
    }
#endif
    for (;;) {
        for (i = 0; i < 3 * D; i++) {
            double *place = i < D ? u + i : i < 2 * D ? ud + (i - D) : udd + (i - 2 * D);
            if (scanf("%lf", place) != 1) {
                return 0;
            }
        }
        /* After a single step that is refused the state is the last good one. */
        single = argc > 1 && strcmp(argv[1], "steps") == 0;
        code = single ? OF(_to)(&s, u) : move(&s, u);
        printf("%d", code);
        code = code == OF(_OK) ? OF(_rates)(&s, ud, udd, qd, qdd) : code;
        print(s.q, qd, qdd);
        if (code != OF(_OK) && !single) {
            return 0;
        }
    }
}
