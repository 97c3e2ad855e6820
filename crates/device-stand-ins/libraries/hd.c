/* A library that stands for libHD, version 3: its functions over mechanics that a test puts in. Written from the
 * documents of the interface, with its numbers and without its text. Without mechanics, the handle rests in the middle
 * and reads no force. Where the documents promise nothing it does the worst: a device that is disabled keeps its force,
 * and a scheduler that is stopped may call once more. Switches for faults begin with stand_in_. */
#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

typedef struct {
    uint32_t code;
    int32_t internal;
    uint32_t device;
} error_info;

typedef uint32_t (*callback)(void *);

/* Force [N] in, position [mm], transform and buttons out. */
typedef void (*mechanics)(const double force[3], double position[3], double transform[16], int32_t *buttons, void *data);

#define ERRORS 64

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static uint32_t errors[ERRORS];
static int count;
static mechanics moves;
static void *moves_data;
static double force[3];
static double position[3];
static double transform[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
static int32_t buttons;
static callback called;
static void *called_data;
static pthread_t thread;
static _Thread_local int in_callback;
static atomic_int running, open_devices, in_frame, enabled, manual;
static atomic_int calibration = 0x5000, inkwell, fails_to_open, opens_with_error, stalled_ms, late_ms, nan_position;
static atomic_int twice, at_once, after_stop, hangs, stop_hangs, disable_hangs, motors_stay, period_us = 1000;
static atomic_int frames, frames_outside;
static double displayed[3];

static void push(uint32_t code) {
    pthread_mutex_lock(&lock);
    if (count < ERRORS) errors[count++] = code;
    pthread_mutex_unlock(&lock);
}
static void nap(long nanoseconds) {
    struct timespec time = {nanoseconds / 1000000000L, nanoseconds % 1000000000L};
    nanosleep(&time, NULL);
}
static void schedule_callback(callback with, void *data) {
    pthread_mutex_lock(&lock);
    called = with;
    called_data = data;
    pthread_mutex_unlock(&lock);
}
/* Calls what is scheduled now, for it may be unscheduled by another thread meanwhile. */
static uint32_t call(void) {
    pthread_mutex_lock(&lock);
    callback with = called;
    void *data = called_data;
    pthread_mutex_unlock(&lock);
    if (!with) return 1;
    in_callback = 1;
    uint32_t again = with(data);
    in_callback = 0;
    return again;
}
static void *call_once(void *unused) {
    (void)unused;
    call();
    return NULL;
}
/* One period: once, twice, or from two threads. Whether there shall be another. */
static int period(void) {
    pthread_t other;
    int second = at_once && pthread_create(&other, NULL, call_once, NULL) == 0;
    uint32_t again = call();
    if (second) pthread_join(other, NULL);
    if (again && twice) again = call();
    return again != 0;
}

/* For tests. */
void stand_in_mechanics(mechanics with, void *data, int device) {
    (void)device;
    pthread_mutex_lock(&lock);
    moves = with;
    moves_data = data;
    pthread_mutex_unlock(&lock);
}
void stand_in_error(int code) { push((uint32_t)code); }
void stand_in_calibration(int state) { calibration = state; }
/* The stylus is put into its inkwell, or taken out. */
void stand_in_inkwell(int in) {
    inkwell = in;
    if (in && calibration == 0x5002) calibration = 0x5001;
}
void stand_in_fails_to_open(int code) { fails_to_open = code; }
void stand_in_opens_with_error(int code) { opens_with_error = code; }
void stand_in_stalls(int milliseconds) { stalled_ms = milliseconds; }
void stand_in_late_ms(int milliseconds) { late_ms = milliseconds; }
void stand_in_period_us(int period) { period_us = period; }
void stand_in_nan(int on) { nan_position = on; }
void stand_in_twice(int on) { twice = on; }
void stand_in_at_once(int on) { at_once = on; }
void stand_in_after_stop(int on) { after_stop = on; }
void stand_in_hangs(int on) { hangs = on; }
void stand_in_stop_hangs(int on) { stop_hangs = on; }
void stand_in_disable_hangs(int on) { disable_hangs = on; }
/* Motors that are switched off keep their force until the next frame. */
void stand_in_motors_stay(int on) { motors_stay = on; }
/* The scheduler has no thread: a test makes its periods. */
void stand_in_manual(int on) { manual = on; }
int stand_in_step(void) { return running && !stalled_ms ? period() : 0; }
int stand_in_frames(void) { return frames; }
int stand_in_frames_outside(void) { return frames_outside; }
int stand_in_open_devices(void) { return open_devices; }
void stand_in_displayed(double out[3], int device) {
    (void)device;
    pthread_mutex_lock(&lock);
    memcpy(out, displayed, sizeof displayed);
    pthread_mutex_unlock(&lock);
}

static void *schedule(void *unused) {
    (void)unused;
    while (running) {
        int late = atomic_exchange(&late_ms, 0);
        if (late) nap(1000000L * late);
        if (stalled_ms) {
            nap(1000000L);
            continue;
        }
        if (!period()) break;
        nap(1000L * period_us);
    }
    return NULL;
}
static void *call_late(void *unused) {
    (void)unused;
    nap(20000000L);
    return call_once(NULL);
}
static void no_force(void) {
    pthread_mutex_lock(&lock);
    memset(displayed, 0, sizeof displayed);
    pthread_mutex_unlock(&lock);
}

/* The interface. */
uint32_t hdInitDevice(const char *name) {
    (void)name;
    if (fails_to_open) {
        push((uint32_t)fails_to_open);
        return 0xFFFFFFFFu;
    }
    if (open_devices) {
        push(0x0301);
        return 0xFFFFFFFFu;
    }
    if (opens_with_error) push((uint32_t)opens_with_error);
    open_devices++;
    return 7;
}
/* It says nothing of the force. */
void hdDisableDevice(uint32_t device) {
    if (device != 7 || !open_devices) push(0x0104);
    else open_devices--;
    if (running) push(0x0500);
}
void hdMakeCurrentDevice(uint32_t device) { if (device != 7) push(0x0104); }
void hdBeginFrame(uint32_t device) {
    if (device != 7) push(0x0104);
    if (in_frame) push(0x0400);
    if (!in_callback) frames_outside++;
    in_frame = 1;
    pthread_mutex_lock(&lock);
    mechanics with = moves;
    void *data = moves_data;
    double held[3];
    memcpy(held, displayed, sizeof held);
    pthread_mutex_unlock(&lock);
    if (with) with(held, position, transform, &buttons, data);
    memset(force, 0, sizeof force);
}
void hdEndFrame(uint32_t device) {
    while (hangs) nap(1000000L);
    if (device != 7) push(0x0104);
    if (!in_frame) push(0x0400);
    in_frame = 0;
    frames++;
    pthread_mutex_lock(&lock);
    /* A force that no frame sets is none. */
    for (int axis = 0; axis < 3; axis++) displayed[axis] = enabled ? force[axis] : 0;
    pthread_mutex_unlock(&lock);
}
error_info hdGetError(void) {
    error_info found = {0, 0, 7};
    pthread_mutex_lock(&lock);
    if (count > 0) found.code = errors[--count];
    pthread_mutex_unlock(&lock);
    return found;
}
void hdEnable(uint32_t what) {
    if (what == 0x4000) enabled = 1;
    else if (what < 0x4000 || what > 0x4004) push(0x0100);
}
void hdDisable(uint32_t what) {
    while (disable_hangs) nap(1000000L);
    if (what < 0x4000 || what > 0x4004) push(0x0100);
    if (what != 0x4000) return;
    enabled = 0;
    if (!motors_stay) no_force();
}
void hdGetDoublev(uint32_t what, double *out) {
    static const double workspace[6] = {-80, -60, -35, 80, 60, 35};
    switch (what) {
    case 0x2050:
        if (!in_frame) push(0x0400);
        memcpy(out, position, sizeof position);
        if (nan_position) out[1] = NAN;
        break;
    case 0x2052:
        if (!in_frame) push(0x0400);
        memcpy(out, transform, sizeof transform);
        break;
    case 0x2551: memcpy(out, workspace, sizeof workspace); break;
    case 0x2603: *out = 3.3; break;
    case 0x2604: *out = 0.88; break;
    default: push(0x0100);
    }
}
void hdGetIntegerv(uint32_t what, int32_t *out) {
    if (what == 0x2000) *out = buttons;
    else push(0x0100);
}
void hdGetBooleanv(uint32_t what, uint8_t *out) {
    if (what == 0x2002) *out = !inkwell;
    else push(0x0100);
}
void hdSetDoublev(uint32_t what, const double *in) {
    if (what != 0x2700) { push(0x0100); return; }
    if (!in_frame) { push(0x0400); return; }
    double size = sqrt(in[0] * in[0] + in[1] * in[1] + in[2] * in[2]);
    if (!(size <= 3.3)) push(0x0201);
    else memcpy(force, in, sizeof force);
}
const char *hdGetString(uint32_t what) {
    switch (what) {
    case 0x2501: return "Stand-in Touch";
    case 0x2504: return "S-1";
    default: push(0x0100); return NULL;
    }
}
uint32_t hdCheckCalibration(void) { return (uint32_t)calibration; }
uint32_t hdCheckCalibrationStyle(void) { return 4; }
void hdUpdateCalibration(uint32_t style) {
    if (style != 4) push(0x0100);
    /* A stylus that is elsewhere is not calibrated by its inkwell. */
    else if (calibration == 0x5001) calibration = 0x5000;
}
void hdStartScheduler(void) {
    if (running) { push(0x0500); return; }
    running = 1;
    if (!manual) pthread_create(&thread, NULL, schedule, NULL);
}
void hdStopScheduler(void) {
    while (stop_hangs) nap(1000000L);
    if (!running) { push(0x0500); return; }
    running = 0;
    if (after_stop && !manual) pthread_detach(thread);
    else if (!manual) pthread_join(thread, NULL);
}
unsigned long hdScheduleAsynchronous(callback with, void *data, uint16_t priority) {
    (void)priority;
    schedule_callback(with, data);
    return 42;
}
void hdUnschedule(unsigned long number) {
    pthread_t late;
    if (number != 42) push(0x0500);
    if (after_stop && pthread_create(&late, NULL, call_late, NULL) == 0) pthread_detach(late);
    else schedule_callback(NULL, NULL);
}
