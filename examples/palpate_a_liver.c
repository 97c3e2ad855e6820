/* Presses 4 mm into the liver and prints the force at once and after 40 s. How to build it: docs/embedding.md. */

#include <math.h>
#include <stdio.h>

#include "palpate.h"

static const char scene[] =
    "format = 1\n"
    "organ = { builtin = \"liver\", builtin_tissue = \"pig-liver\" }\n"
    "tool = [{ name = \"right\", tip = { shape = \"flat\", radius_m = 0.001 } }]\n";

static double length(const double vector[3]) {
    return sqrt(vector[0] * vector[0] + vector[1] * vector[1] + vector[2] * vector[2]);
}

int main(void) {
    palpate_simulation *simulation = NULL; /* the organ and its tools; never changes */
    palpate_state *state = NULL;           /* what a step changes */
    palpate_surface surface;
    palpate_pose pose = {.is_there = 1};
    palpate_touch touch;
    double first = 0.0;

    if (palpate_simulation_open_text(scene, "liver.toml", NULL, &simulation) != PALPATE_OK ||
        palpate_simulation_surface(simulation, &surface) != PALPATE_OK ||
        palpate_state_new(simulation, &state) != PALPATE_OK) {
        goto refused;
    }

    /* 4 mm below the first vertex, along its inward normal. */
    const double *outward = palpate_simulation_normals(simulation);
    for (int axis = 0; axis < 3; axis++) {
        pose.position_m[axis] = surface.vertices_m[axis] - 0.004 * outward[axis];
    }

    for (int step = 0; step <= 400; step++) {
        if (palpate_step(state, 0.1 * step, &pose, 1, &touch) != PALPATE_OK) {
            goto refused;
        }
        if (step == 0) {
            first = length(touch.force_n);
        }
    }
    printf("%.4f N at once, %.4f N after 40 s\n", first, length(touch.force_n));

    palpate_state_free(state);
    palpate_simulation_free(simulation);
    return 0;

refused:
    fprintf(stderr, "palpate: %s\n", palpate_error_message());
    palpate_state_free(state);
    palpate_simulation_free(simulation);
    return 1;
}
