/* A library that stands for libdhd, version 3: its functions over mechanics that a test puts in. Written from the
 * documents of the interface, with its numbers and without its text. Without mechanics, the handle rests in the middle.
 * Where the documents promise nothing it does the worst: a device that is closed keeps its force, and one that took its
 * forces off displays none until they are enabled again. Switches for faults begin with stand_in_. */
#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <string.h>
#include <time.h>

/* Force [N] in, position [m], rows of the frame and buttons out. */
typedef void (*mechanics)(const double force[3], double position[3], double frame[9], unsigned *buttons, void *data);

#define DEVICES 4

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static mechanics moves[DEVICES];
static void *moves_data[DEVICES];
static double position[DEVICES][3], displayed[DEVICES][3];
static double frame[DEVICES][9];
static unsigned buttons[DEVICES];
static double most[DEVICES], watchdog[DEVICES], last_set[DEVICES];
static atomic_int is_open[DEVICES], enabled[DEVICES], cause[DEVICES];
static atomic_int devices = 1, fails_to_open, stalled_ms, nan_position, answer, hangs, has_watchdog;
static atomic_int power = 1, connected = 1, error_state, refuses, last_error;

static double now(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}
/* With the lock: forces off, for this reason, until they are enabled. */
static void take_off(int device, int why) {
    enabled[device] = 0;
    cause[device] = why;
    memset(displayed[device], 0, sizeof displayed[device]);
}
/* With the lock: what the device does by itself without a force for as long as its watchdog has. */
static void watch(int device) {
    int bites = watchdog[device] > 0 && enabled[device] && now() - last_set[device] > watchdog[device];
    if (bites) take_off(device, 3);
}

/* For tests. */
void stand_in_mechanics(mechanics with, void *data, int device) {
    pthread_mutex_lock(&lock);
    moves[device] = with;
    moves_data[device] = data;
    pthread_mutex_unlock(&lock);
}
void stand_in_devices(int number) { devices = number; }
void stand_in_fails_to_open(int on) { fails_to_open = on; }
void stand_in_stalls(int milliseconds) { stalled_ms = milliseconds; }
void stand_in_hangs(int on) { hangs = on; }
void stand_in_nan(int on) { nan_position = on; }
void stand_in_error(int code) { answer = code ? -1 : 0; last_error = code; }
void stand_in_power(int on) { power = on; }
void stand_in_connected(int on) { connected = on; }
void stand_in_error_state(int on) { error_state = on; }
/* Devices of newer versions have a watchdog. */
void stand_in_watchdog(int on) { has_watchdog = on; }
/* Forces cannot be enabled. */
void stand_in_refuses(int on) { refuses = on; }
/* The first device takes its forces off. */
void stand_in_cause(int why) {
    pthread_mutex_lock(&lock);
    take_off(0, why);
    pthread_mutex_unlock(&lock);
}
int stand_in_open_devices(void) {
    int open = 0;
    for (int device = 0; device < DEVICES; device++) open += is_open[device];
    return open;
}
void stand_in_displayed(double out[3], int device) {
    pthread_mutex_lock(&lock);
    watch(device);
    memcpy(out, displayed[device], sizeof displayed[device]);
    pthread_mutex_unlock(&lock);
}

static void stall(void) {
    struct timespec time = {stalled_ms / 1000, stalled_ms % 1000 * 1000000L};
    if (stalled_ms) nanosleep(&time, NULL);
    struct timespec tick = {0, 1000000L};
    while (hangs) nanosleep(&tick, NULL);
}
static int is_there(char id) { return id >= 0 && id < DEVICES && is_open[(int)id]; }
static int failed(int code) {
    last_error = code;
    return -1;
}

/* The interface. */
int dhdGetDeviceCount(void) { return devices; }
int dhdOpenID(char index) {
    int device = index;
    if (fails_to_open || device < 0 || device >= devices || is_open[device]) return failed(2);
    for (int entry = 0; entry < 9; entry++) frame[device][entry] = entry % 4 == 0;
    most[device] = -1;
    pthread_mutex_lock(&lock);
    watchdog[device] = 0;
    enabled[device] = cause[device] = 0;
    pthread_mutex_unlock(&lock);
    is_open[device] = 1;
    return device;
}
/* It says nothing of the force. */
int dhdClose(char id) {
    if (!is_there(id)) return failed(4);
    is_open[(int)id] = 0;
    return 0;
}
int dhdEnableForce(unsigned char on, char id) {
    if (!is_there(id)) return failed(4);
    if (on && refuses) return failed(6);
    pthread_mutex_lock(&lock);
    if (on) {
        enabled[(int)id] = 1;
        cause[(int)id] = 0;
        last_set[(int)id] = now();
    } else take_off((int)id, cause[(int)id] ? cause[(int)id] : 4);
    pthread_mutex_unlock(&lock);
    return 0;
}
int dhdSetMaxForce(double limit, char id) {
    if (!is_there(id)) return failed(4);
    most[(int)id] = limit;
    return 0;
}
int dhdSetWatchdog(unsigned char duration, char id) {
    if (!is_there(id) || !has_watchdog) return failed(4);
    pthread_mutex_lock(&lock);
    watchdog[(int)id] = 125e-6 * duration;
    pthread_mutex_unlock(&lock);
    return 0;
}
int dhdSetForce(double fx, double fy, double fz, char id) {
    stall();
    if (!is_there(id)) return failed(4);
    if (answer) return -1;
    double force[3] = {fx, fy, fz};
    double size = sqrt(fx * fx + fy * fy + fz * fz);
    if (!isfinite(size)) return failed(5);
    double part = most[(int)id] >= 0 && size > most[(int)id] ? most[(int)id] / size : 1;
    pthread_mutex_lock(&lock);
    watch((int)id);
    last_set[(int)id] = now();
    int is_on = enabled[(int)id] && power && connected;
    mechanics with = moves[(int)id];
    void *data = moves_data[(int)id];
    double held[3];
    memcpy(held, displayed[(int)id], sizeof held);
    for (int axis = 0; axis < 3; axis++) displayed[(int)id][axis] = is_on ? part * force[axis] : 0;
    pthread_mutex_unlock(&lock);
    if (with) with(held, position[(int)id], frame[(int)id], &buttons[(int)id], data);
    return part < 1 ? 2 : 0;
}
int dhdGetPosition(double *x, double *y, double *z, char id) {
    if (!is_there(id)) return failed(4);
    *x = position[(int)id][0];
    *y = nan_position ? NAN : position[(int)id][1];
    *z = position[(int)id][2];
    return 1;
}
int dhdGetOrientationFrame(double out[3][3], char id) {
    if (!is_there(id)) return failed(4);
    memcpy(out, frame[(int)id], sizeof frame[0]);
    return 0;
}
unsigned dhdGetButtonMask(char id) { return is_there(id) ? buttons[(int)id] : 0; }
int dhdGetStatus(int status[], char id) {
    if (!is_there(id)) return failed(4);
    memset(status, 0, 16 * sizeof(int));
    status[0] = power;
    status[1] = connected;
    status[2] = 1;
    status[5] = enabled[(int)id];
    status[9] = error_state;
    status[14] = cause[(int)id];
    return 0;
}
const char *dhdGetSystemName(char id) { return is_there(id) ? "stand-in.3" : NULL; }
int dhdErrorGetLast(void) { return last_error; }
const char *dhdErrorGetLastStr(void) { return last_error ? "an error of the stand-in" : "no error"; }
