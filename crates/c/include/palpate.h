/*
 * palpate: tools that meet an organ, for programs that speak C.
 *
 * Written by cbindgen of crates/c/src; change that, not this. How to build and link: docs/embedding.md.
 *
 * Metres, newtons, seconds, in the scene's frame. A palpate_simulation is made once and never changes: any number of
 * threads may use it. A palpate_state is all that a step changes: one thread at a time may use it; a call that meets
 * another one in it is refused.
 *
 * A call that cannot be done returns what kind of reason there is, changes nothing, and palpate_error_message() has the
 * sentence. Pointers that are null or not aligned are refused; a pointer has to come from here, or from an array as
 * long as said, and nothing may be used after it was freed. No exception and no longjmp may pass through these functions.
 */


#ifndef PALPATE_H
#define PALPATE_H

#include <stddef.h>
#include <stdint.h>

/**
 * It touches the organ, which it did not in the step before.
 */
#define PALPATE_EVENT_CONTACT (1 << 0)

/**
 * It no longer touches the organ.
 */
#define PALPATE_EVENT_RELEASE (1 << 1)

/**
 * It takes hold.
 */
#define PALPATE_EVENT_GRIP (1 << 2)

/**
 * It lets go.
 */
#define PALPATE_EVENT_GRIP_RELEASE (1 << 3)

/**
 * Its blade opens at least one layer, or the organ where there are no layers.
 */
#define PALPATE_EVENT_CUT (1 << 4)

/**
 * It opens the innermost layer.
 */
#define PALPATE_EVENT_PERFORATION (1 << 5)

/**
 * Its shaft, not its tip, touches the organ.
 */
#define PALPATE_EVENT_SHAFT_CONTACT (1 << 6)

/**
 * It is deeper than the models can be trusted: beyond 10 mm.
 */
#define PALPATE_EVENT_DEPTH_BEYOND_TRUST (1 << 7)

/**
 * The model gave a force that is no number; it was replaced by zero.
 */
#define PALPATE_EVENT_NON_FINITE_FORCE (1 << 8)

/**
 * Before the step the last cut was closed again.
 */
#define PALPATE_EVENT_UNDO_CUT (1 << 11)

/**
 * It moved faster than a hand can: it lost what it touched and held, and touches anew where it is now.
 */
#define PALPATE_EVENT_JUMP (1 << 13)

/**
 * The organ gave back more work than was done on it.
 */
#define PALPATE_EVENT_ENERGY_GAIN (1 << 14)

/**
 * It opens the outermost layer of the organ at its tip.
 */
#define PALPATE_EVENT_OPENS_LAYER_1 (1 << 15)

/**
 * It opens the second layer from outside.
 */
#define PALPATE_EVENT_OPENS_LAYER_2 (1 << 16)

/**
 * It opens the third layer from outside.
 */
#define PALPATE_EVENT_OPENS_LAYER_3 (1 << 17)

/**
 * It opens the fourth layer from outside.
 */
#define PALPATE_EVENT_OPENS_LAYER_4 (1 << 18)

/**
 * It opens the fifth layer from outside.
 */
#define PALPATE_EVENT_OPENS_LAYER_5 (1 << 19)

/**
 * It opens the sixth layer from outside.
 */
#define PALPATE_EVENT_OPENS_LAYER_6 (1 << 20)

/**
 * Its shaft no longer touches the organ.
 */
#define PALPATE_EVENT_SHAFT_RELEASE (1 << 21)

/**
 * From this step on the direction of its shaft is not known, so that only its tip and jaws touch an organ that bends.
 */
#define PALPATE_EVENT_SHAFT_UNKNOWN (1 << 22)

/**
 * The direction of its shaft is known again.
 */
#define PALPATE_EVENT_SHAFT_KNOWN (1 << 23)

/**
 * No equilibrium of the organ was found: it is at rest again, and the tool has lost what it touched and held.
 */
#define PALPATE_EVENT_NO_EQUILIBRIUM (1 << 24)

/**
 * The version of this header.
 */
#define PALPATE_VERSION_MAJOR 0

/**
 * The version of this header.
 */
#define PALPATE_VERSION_MINOR 2

/**
 * The version of this header.
 */
#define PALPATE_VERSION_PATCH 0

/**
 * The layout of structures and the signatures of functions in this header. It changes whenever programs have to be
 * recompiled; a program that loads the library at run time compares it with palpate_abi() first.
 */
#define PALPATE_ABI 2

/**
 * How a call ended: the exit statuses of the command `palpate`.
 */
typedef enum palpate_status {
    /**
     * It was done.
     */
    PALPATE_OK = 0,
    /**
     * It was not, and what was given is not at fault: a file that may not be read, a defect, a preparation that was
     * cancelled.
     */
    PALPATE_FAILED = 1,
    /**
     * It was not: what was given is invalid.
     */
    PALPATE_BAD_INPUT = 2,
} palpate_status;

/**
 * An organ and the tools that may touch it. It never changes: any number of threads may use it.
 */
typedef struct palpate_simulation palpate_simulation;

/**
 * All that a step changes. One thread at a time may use it; each may have one of its own.
 */
typedef struct palpate_state palpate_state;

/**
 * Hears how far a long preparation is: what is being done, in words that are gone when it returns, and how much of it
 * is done, from 0 to 1. Other than 0 breaks it off. It is called by the thread that opens the scene, with the `data` of
 * the preparation. No exception may leave it.
 */
typedef int (*palpate_watch)(const char *work, double part, void *data);

/**
 * What may be used to prepare a scene. All zero is as good as none: nobody listens, nothing is kept, eight gibibytes
 * may be used.
 */
typedef struct palpate_preparation {
    /**
     * Hears how far it is; may be null.
     */
    palpate_watch watch;
    /**
     * Is given to `watch`.
     */
    void *data;
    /**
     * The folder in which responses of whole organs (`model.kind = "hybrid"`) are kept and looked for first; null:
     * they are solved anew each time, which takes from seconds to minutes.
     */
    const char *responses;
    /**
     * Memory [byte] that may be taken; what needs more is refused before it begins; 0: eight gibibytes.
     */
    uint64_t memory;
} palpate_preparation;

/**
 * Where a tool is. All zero is a tool that is not there.
 */
typedef struct palpate_pose {
    /**
     * The tip in the scene's frame [m].
     */
    double position_m[3];
    /**
     * The quaternion (qx, qy, qz, qw) of length 1 that takes the tool's frame to the scene's [-]; the shaft runs along
     * the tool's +z, away from the tissue. Read if `has_orientation`.
     */
    double orientation[4];
    /**
     * How far its jaws are shut, from 0 to 1 [-].
     */
    double grip;
    /**
     * Other than 0: somebody holds it; else the rest is not read.
     */
    uint8_t is_there;
    /**
     * Other than 0: `orientation` is stated; else the shaft stands on the surface, or runs to its trocar.
     */
    uint8_t has_orientation;
    /**
     * Other than 0: its blade is lowered.
     */
    uint8_t cut;
} palpate_pose;

/**
 * What a tool feels after a step.
 */
typedef struct palpate_touch {
    /**
     * The force of the tissue on it, in the scene's frame [N].
     */
    double force_n[3];
    /**
     * For a loop that is quicker than the steps: up to 5 mm from where the step had the tip, the force is
     * `with_pull_n` + `gradient_n_per_m` times the way from there, of which what pulls along `normal` is left out unless
     * the jaws hold.
     */
    double with_pull_n[3];
    /**
     * How the force changes with the tip: row by row, change of x, y, z of the force per metre [N/m].
     */
    double gradient_n_per_m[9];
    /**
     * The touched point of the surface at rest [m]; zero without contact.
     */
    double point_m[3];
    /**
     * Unit outward normal of the surface at rest there [-]; zero without contact.
     */
    double normal[3];
    /**
     * How far the tip is below the surface at rest [m].
     */
    double depth_m;
    /**
     * The quaternion (qx, qy, qz, qw) that takes the tool's frame to the scene's, as it was stated or found [-].
     */
    double orientation[4];
    /**
     * With how much each of its jaws presses on the tissue between them [N].
     */
    double grip_force_n;
    /**
     * The torque on it about its tip, in the scene's frame [N m]: of tissue that bears on the shaft of a tool without a
     * trocar.
     */
    double torque_nm[3];
    /**
     * What happened to it in this step: a sum of PALPATE_EVENT_....
     */
    uint32_t events;
    /**
     * 1 if its tip touches or its jaws hold, else 0.
     */
    uint8_t contact;
    /**
     * 1 if its jaws hold tissue, else 0.
     */
    uint8_t holds;
} palpate_touch;

/**
 * The triangles of an organ. The arrays are the library's own, to be read only.
 */
typedef struct palpate_surface {
    /**
     * x, y, z of each vertex in the scene's frame [m].
     */
    const double *vertices_m;
    /**
     * How many vertices there are.
     */
    size_t vertices;
    /**
     * The three vertices of each triangle, counter-clockwise seen from outside, counted from 0.
     */
    const uint32_t *corners;
    /**
     * How many triangles there are.
     */
    size_t triangles;
    /**
     * Another number whenever the triangles of a state are others; 0: they are those at rest, nothing is cut.
     */
    uint64_t version;
} palpate_surface;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/**
 * The sentence that says why a call of this thread was refused the last time: cause, then remedy; UTF-8; empty before
 * that. It stays until the next refused call of this thread. A call that succeeds leaves it as it is.
 */
const char *palpate_error_message(void);

/**
 * Reads the scene file `path` and prepares it: `*simulation` has to be freed. `how` may be null. Where it is refused,
 * `*simulation` is null.
 */
enum palpate_status palpate_simulation_open(const char *path,
                                            const struct palpate_preparation *how,
                                            struct palpate_simulation **simulation);

/**
 * The same for the text of a scene. `name` is its name in errors, and relative paths in it begin in its folder.
 */
enum palpate_status palpate_simulation_open_text(const char *text,
                                                 const char *name,
                                                 const struct palpate_preparation *how,
                                                 struct palpate_simulation **simulation);

/**
 * Frees a simulation; its states go on. Null is nothing.
 */
void palpate_simulation_free(struct palpate_simulation *simulation);

/**
 * How many tools the scene has; 0 for a null pointer.
 */
size_t palpate_tool_count(const struct palpate_simulation *simulation);

/**
 * The name of a tool, counted from 0 in the scene's order, for as long as the simulation lives; null where there is
 * none.
 */
const char *palpate_tool_name(const struct palpate_simulation *simulation,
                              size_t tool);

/**
 * The number of warnings about this scene; 0 for a null pointer.
 */
size_t palpate_warning_count(const struct palpate_simulation *simulation);

/**
 * A warning, counted from 0, one sentence; valid for as long as the simulation lives; null where there is none.
 */
const char *palpate_warning(const struct palpate_simulation *simulation,
                            size_t number);

/**
 * The step [s] that the scene asks for, `model.step_s`; 0 for a null pointer. Steps of other lengths are as good.
 */
double palpate_step_length(const struct palpate_simulation *simulation);

/**
 * The factor [-] by which the scene wants forces felt, `model.force_scale`; the forces of a step are without it. 0 for
 * a null pointer.
 */
double palpate_force_scale(const struct palpate_simulation *simulation);

/**
 * Makes a state in which nothing was touched yet: `*state` has to be freed. It keeps what it needs of the simulation,
 * which may be freed before it. Where it is refused, `*state` is null.
 */
enum palpate_status palpate_state_new(const struct palpate_simulation *simulation,
                                      struct palpate_state **state);

/**
 * Makes a second state that is as `state` is now: to come back to (palpate_state_restore), or to go on from elsewhere.
 * `*copy` has to be freed. Where it is refused, `*copy` is null.
 */
enum palpate_status palpate_state_clone(const struct palpate_state *state,
                                        struct palpate_state **copy);

/**
 * Makes `state` as `from` is now; both are states of one simulation.
 */
enum palpate_status palpate_state_restore(struct palpate_state *state,
                                          const struct palpate_state *from);

/**
 * Makes the organ whole and at rest, as if nothing had been touched yet; time begins anew.
 */
enum palpate_status palpate_state_reset(struct palpate_state *state);

/**
 * Closes the last cut again, in the next step, which tells so (PALPATE_EVENT_UNDO_CUT). Nothing happens where there is
 * none, or one is being made.
 */
enum palpate_status palpate_state_undo_cut(struct palpate_state *state);

/**
 * Shapes the organ for the eye no more often than every `period_s` [s]; forces are those
 * of every step. 0, as it is at first: in each.
 */
enum palpate_status palpate_state_show_every(struct palpate_state *state, double period_s);

/**
 * Frees a state. Null is nothing.
 */
void palpate_state_free(struct palpate_state *state);

/**
 * Takes a state one step on to `time_s` [s], with its tools at `poses`, and tells at `touches` what they feel: arrays of
 * `tools`, in the scene's order; `touches` may be null. What lies between the tool's last place and this one took the
 * time since the last step; a first one has no time before it, and whatever depth there is comes as a jump. A step
 * waits for nothing and, but for a cut that adds triangles, allocates nothing.
 */
enum palpate_status palpate_step(struct palpate_state *state,
                                 double time_s,
                                 const struct palpate_pose *poses,
                                 size_t tools,
                                 struct palpate_touch *touches);

/**
 * The organ at rest, for as long as the simulation lives.
 */
enum palpate_status palpate_simulation_surface(const struct palpate_simulation *simulation,
                                               struct palpate_surface *surface);

/**
 * x, y, z of the unit outward normal at each vertex of the organ at rest [-], for as long as the simulation lives; null
 * for a null pointer.
 */
const double *palpate_simulation_normals(const struct palpate_simulation *simulation);

/**
 * The organ as it is deformed and cut now, until the next call that changes the state. Uncut it has the vertices and
 * triangles of the organ at rest, in their order; a cut changes some and adds others.
 */
enum palpate_status palpate_state_surface(const struct palpate_state *state,
                                          struct palpate_surface *surface);

/**
 * The PALPATE_ABI of the library.
 */
uint32_t palpate_abi(void);

/**
 * The version of the library, as "0.2.0".
 */
const char *palpate_version(void);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* PALPATE_H */
