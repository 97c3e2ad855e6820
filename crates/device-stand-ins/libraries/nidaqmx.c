/* A library that stands for libnidaqmx: the functions that are used, over six voltages that are set. */

#include <stdint.h>
#include <string.h>
#include <unistd.h>

static double volts[6];
static double rate = 1000.0;
static volatile int failing;
static volatile int hanging;
static int tasks;
static const char *channels_known = "Dev1/ai0:5";
static int task;

/* Switches. */
void stand_in_volts(const double *values) { memcpy(volts, values, sizeof volts); }
void stand_in_fail(int code) { failing = code; }
void stand_in_hang(int hangs) { hanging = hangs; }
int stand_in_tasks(void) { return tasks; }

int32_t DAQmxCreateTask(const char *name, void **handle) {
    (void)name;
    *handle = &task;
    tasks++;
    return 0;
}

int32_t DAQmxCreateAIVoltageChan(void *handle, const char *channels, const char *name, int32_t terminals, double least,
                                 double most, int32_t units, const char *scale) {
    (void)name;
    if (handle != &task || terminals != 10106 || units != 10348 || scale || least != -most)
        return -1;
    return strcmp(channels, channels_known) ? -200220 : 0;
}

int32_t DAQmxCfgSampClkTiming(void *handle, const char *source, double hz, int32_t edge, int32_t mode, uint64_t room) {
    if (handle != &task || source || edge != 10280 || mode != 10123 || room < hz)
        return -1;
    rate = hz;
    return 0;
}

int32_t DAQmxStartTask(void *handle) { return handle == &task ? 0 : -1; }
int32_t DAQmxStopTask(void *handle) { return handle == &task ? 0 : -1; }

int32_t DAQmxClearTask(void *handle) {
    tasks--;
    return handle == &task ? 0 : -1;
}

int32_t DAQmxReadAnalogF64(void *handle, int32_t samples, double timeout, uint32_t by_scan, double *values, uint32_t room,
                           int32_t *read, uint32_t *reserved) {
    *read = 0;
    if (handle != &task || by_scan != 1 || reserved || (uint32_t)samples * 6 > room || timeout <= 0.0)
        return -1;
    while (hanging)
        usleep(1000);
    if (failing)
        return failing;
    usleep((useconds_t)(1e6 * samples / rate));
    for (int32_t scan = 0; scan < samples; scan++)
        memcpy(values + 6 * scan, volts, sizeof volts);
    *read = samples;
    return 0;
}

int32_t DAQmxGetExtendedErrorInfo(char *text, uint32_t room) {
    strncpy(text, "Device identifier is invalid.\nStatus Code: -200220", room);
    return 0;
}
