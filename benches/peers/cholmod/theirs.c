/* SuiteSparse's side of the comparison of factor and solve; compare.py compiles and runs it.
 *
 * Needs (Debian) gcc, libsuitesparse-dev, libopenblas0-serial.
 *
 * theirs CODE FILE REPEATS reads a symmetric matrix and prints the least of the times as JSON. CODE:
 *   ldlt     CHOLMOD, simplicial L D L^T: any quasi-definite matrix
 *   llt      CHOLMOD, supernodal L L^T: a positive definite matrix
 *   dominant the same on the same pattern, made definite by a large diagonal
 *   umfpack  UMFPACK, unsymmetric LU
 * The order of elimination is AMD for CHOLMOD, as for us, and UMFPACK's own choice. */
#include <cholmod.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <umfpack.h>

static double now(void) {
    struct timespec t;
    /* On the processor: a busy machine does not count. */
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return t.tv_sec + 1e-9 * t.tv_nsec;
}

#define LEAST(least, start)                                                                        \
    do {                                                                                           \
        double took = now() - (start);                                                             \
        if (took < least) least = took;                                                            \
    } while (0)

static void print(long n, double entries, double order, double factor, double solve, double residual) {
    printf("{\"unknowns\": %ld, \"factor_entries\": %.0f, \"order_s\": %g, \"factor_s\": %g, "
           "\"solve_s\": %g, \"residual\": %g}\n", n, entries, order, factor, solve, residual);
}

/* |1 - K x| over |K||x| + 1, row by row, the largest; of K the lower or upper triangle is stored. */
static double residual(cholmod_sparse *k, const double *x) {
    long n = k->nrow, *columns = k->p, *rows = k->i;
    double *values = k->x, largest = 0;
    double *left = malloc(n * sizeof(double)), *sums = malloc(n * sizeof(double));
    for (long i = 0; i < n; i++) left[i] = sums[i] = 1;
    for (long j = 0; j < n; j++)
        for (long e = columns[j]; e < columns[j + 1]; e++) {
            long i = rows[e];
            left[i] -= values[e] * x[j];
            sums[i] += fabs(values[e] * x[j]);
            if (i == j) continue;
            left[j] -= values[e] * x[i];
            sums[j] += fabs(values[e] * x[i]);
        }
    for (long i = 0; i < n; i++) largest = fmax(largest, fabs(left[i] / sums[i]));
    return largest;
}

static void with_cholmod(cholmod_sparse *k, const char *code, int repeats, cholmod_common *c) {
    long n = k->nrow;
    int simplicial = !strcmp(code, "ldlt");
    c->supernodal = simplicial ? CHOLMOD_SIMPLICIAL : CHOLMOD_SUPERNODAL;
    c->nmethods = 1;
    c->method[0].ordering = CHOLMOD_AMD;
    c->postorder = 1;
    if (!strcmp(code, "dominant")) {
        long *columns = k->p, *rows = k->i;
        double *values = k->x, largest = cholmod_l_norm_sparse(k, 0, c);
        for (long j = 0; j < n; j++)
            for (long e = columns[j]; e < columns[j + 1]; e++)
                if (rows[e] == j) values[e] = 2 * largest;
    }
    double start = now(), order, factor = 1e30, solve = 1e30;
    cholmod_factor *l = cholmod_l_analyze(k, c);
    order = now() - start;
    cholmod_dense *ones = cholmod_l_ones(n, 1, CHOLMOD_REAL, c), *x = NULL, *y = NULL, *e = NULL;
    for (int i = 0; i < repeats; i++) {
        start = now();
        cholmod_l_factorize(k, l, c);
        LEAST(factor, start);
        start = now();
        cholmod_l_solve2(CHOLMOD_A, l, ones, NULL, &x, NULL, &y, &e, c);
        LEAST(solve, start);
    }
    print(n, l->is_super ? (double)l->xsize : (double)l->nzmax, order, factor, solve,
          residual(k, x->x));
}

static void with_umfpack(cholmod_sparse *k, int repeats, cholmod_common *c) {
    cholmod_sparse *a = cholmod_l_copy(k, 0, 1, c);
    long n = a->nrow;
    double control[UMFPACK_CONTROL], info[UMFPACK_INFO];
    umfpack_dl_defaults(control);
    double *x = malloc(n * sizeof(double)), *ones = malloc(n * sizeof(double));
    for (long i = 0; i < n; i++) ones[i] = 1;
    void *symbolic, *numeric = NULL;
    double start = now(), order, factor = 1e30, solve = 1e30;
    umfpack_dl_symbolic(n, n, a->p, a->i, a->x, &symbolic, control, info);
    order = now() - start;
    for (int i = 0; i < repeats; i++) {
        if (numeric) umfpack_dl_free_numeric(&numeric);
        start = now();
        umfpack_dl_numeric(a->p, a->i, a->x, symbolic, &numeric, control, info);
        LEAST(factor, start);
        start = now();
        umfpack_dl_solve(UMFPACK_A, a->p, a->i, a->x, x, ones, numeric, control, info);
        LEAST(solve, start);
    }
    print(n, info[UMFPACK_LNZ] + info[UMFPACK_UNZ], order, factor, solve, residual(k, x));
}

int main(int count, char **words) {
    if (count != 4) return fprintf(stderr, "theirs CODE FILE REPEATS\n"), 2;
    cholmod_common c;
    cholmod_l_start(&c);
    FILE *file = fopen(words[2], "r");
    cholmod_sparse *k = file ? cholmod_l_read_sparse(file, &c) : NULL;
    if (!k) return fprintf(stderr, "cannot read %s\n", words[2]), 1;
    if (!strcmp(words[1], "umfpack")) with_umfpack(k, atoi(words[3]), &c);
    else with_cholmod(k, words[1], atoi(words[3]), &c);
    return 0;
}
