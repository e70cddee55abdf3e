/* A stand-in for libusb-1.0 with Kinects (v1) on it that do not exist.
 *
 * It has the symbols that libfreenect 0.5 imports and speaks the device's own protocol: commands and replies of the
 * camera, registers, factory parameters, motor and LED requests, isochronous packets with 12-byte headers. Loaded
 * before libfreenect (LD_PRELOAD), it takes the place of libusb for the whole process. What tests ask of it begins
 * with emulated_: plugging, pushing pictures, faults, and a log of all registers that were written.
 *
 * Protocol: libfreenect 0.5.3, src/cameras.c, src/flags.c, src/tilt.c; openkinect.org, "Protocol Documentation".
 * One lock for everything; callbacks run without it, in whichever thread handles events, as in libusb.
 */
#include <pthread.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>
#include <libusb.h>

enum { MOST_KINECTS = 16, MOST_DEVICES = 4 * MOST_KINECTS, LOG_LENGTH = 65536 };
enum { MICROSOFT = 0x045e, CAMERA_1414 = 0x02ae, MOTOR = 0x02b0, AUDIO_1414 = 0x02ad, CAMERA_K4W = 0x02bf, AUDIO_K4W = 0x02be };
enum { MODEL_1414, MODEL_1473, MODEL_K4W };
enum { DEPTH, VIDEO, STREAMS };
enum { HEADER = 12, WIDTH = 640, HEIGHT = 480, PIXELS = WIDTH * HEIGHT };
enum { HANG_NOTHING, HANG_CONTROL, HANG_EVENTS, HANG_EMPTY };
static const uint8_t ENDPOINT[STREAMS] = {0x82, 0x81};
static const uint8_t FLAG[STREAMS] = {0x70, 0x80};
static const int PACKET[STREAMS] = {1760, 1920};
static const int FRAME[STREAMS] = {PIXELS * 11 / 8, PIXELS};

typedef struct transfer {
    struct transfer *next;
    int filled, canceled;
    struct libusb_transfer t;
} transfer;
typedef struct { transfer *first, *last; } fifo;

struct libusb_device {
    libusb_context *ctx;
    struct kinect *kinect;
    int product, generation; /* plugged in for the so-manieth time */
    struct libusb_device *parent;
};
enum { HUB, CAMERA, AUDIO, MOTOR_, PARTS };
struct libusb_context {
    fifo done;
    libusb_device *devices[MOST_KINECTS][PARTS];
};
struct libusb_device_handle {
    libusb_context *ctx;
    libusb_device *dev;
    int claimed;
    fifo pending[STREAMS];
};

typedef struct kinect {
    int index, model, plugged, generation, bus, busy, denied, hang, stalled, no_bandwidth, kernel_driver;
    int restarts, away; /* for so many looks its microphone is away after a reset, and is still */
    char serial[64], audio_serial[64];
    libusb_device_handle *owner; /* of the camera's interface */
    uint16_t registers[0x1000], cmos[0x200];
    uint8_t reply[0x200];
    int reply_length;
    uint8_t seq[STREAMS], garbage[STREAMS];
    uint8_t registration[116], zero_plane[16];
    uint16_t start_lines, const_shift;
    long lose_every, sent, late; /* every Nth packet is lost on the way */
    int lose_first, lose_count;   /* within the next depth picture */
    int led, tilt, led_alt;
    int16_t accel[3];
} kinect;

typedef struct { int64_t t_ns; int kinect, reg, value; } log_entry;

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static pthread_cond_t changed;
static int no_hubs; /* the system does not say what hangs on what */
static kinect kinects[MOST_KINECTS];
static int count, motor_order[MOST_KINECTS], open_handles, contexts, live_transfers;
static log_entry log_[LOG_LENGTH];
static int logged;

static __attribute__((constructor)) void begin(void) {
    pthread_condattr_t attributes;
    pthread_condattr_init(&attributes);
    pthread_condattr_setclock(&attributes, CLOCK_MONOTONIC);
    pthread_cond_init(&changed, &attributes);
}

static int64_t now_ns(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return t.tv_sec * 1000000000LL + t.tv_nsec;
}

static void wait_until(int64_t until_ns) { /* with the lock held */
    struct timespec t = {until_ns / 1000000000LL, until_ns % 1000000000LL};
    pthread_cond_timedwait(&changed, &lock, &t);
}

static void note(kinect *k, int reg, int value) {
    log_[logged++ % LOG_LENGTH] = (log_entry){now_ns(), k->index, reg, value};
}

static void append(fifo *f, transfer *x) {
    x->next = NULL;
    if (f->last) f->last->next = x; else f->first = x;
    f->last = x;
}
static transfer *take(fifo *f) {
    transfer *x = f->first;
    if (x && !(f->first = x->next)) f->last = NULL;
    return x;
}
static int remove_from(fifo *f, transfer *x) {
    transfer *before = NULL;
    for (transfer *at = f->first; at; before = at, at = at->next) {
        if (at != x) continue;
        if (before) before->next = x->next; else f->first = x->next;
        if (f->last == x) f->last = before;
        return 1;
    }
    return 0;
}
static transfer *of(struct libusb_transfer *t) { return (transfer *)((char *)t - offsetof(transfer, t)); }

static void complete(libusb_device_handle *h, transfer *x, enum libusb_transfer_status status) {
    x->t.status = status;
    append(&h->ctx->done, x);
    pthread_cond_broadcast(&changed);
}

/* What tests ask for */

static void plug_in(kinect *k) {
    k->generation++;
    memset(k->registers, 0, sizeof k->registers);
    memset(k->seq, 0, sizeof k->seq);
    k->cmos[0x106] = 0x7 | 1 << 14 | 1 << 1;
    k->reply_length = 0; k->owner = NULL; k->plugged = 1; k->led = k->tilt = k->led_alt = 0;
}
static void pull_out(kinect *k) {
    k->plugged = 0;
    k->hang = HANG_NOTHING; /* the kernel ends what waits for a device that is gone */
    if (k->owner)
        for (int s = 0; s < STREAMS; s++)
            for (transfer *x; (x = take(&k->owner->pending[s]));) complete(k->owner, x, LIBUSB_TRANSFER_NO_DEVICE);
    k->owner = NULL;
    pthread_cond_broadcast(&changed);
}

void emulated_reset(int n) {
    pthread_mutex_lock(&lock);
    for (int i = 0; i < count; i++) if (kinects[i].plugged) pull_out(&kinects[i]);
    count = n; logged = 0;
    for (int i = 0; i < n; i++) {
        kinect *k = &kinects[i];
        int generation = k->generation;
        memset(k, 0, sizeof *k);
        k->generation = generation; k->index = i; k->bus = 1 + i; motor_order[i] = i;
        snprintf(k->serial, sizeof k->serial, "A%015d", i + 1);
        snprintf(k->audio_serial, sizeof k->audio_serial, "B%015d", i + 1);
        float zero_plane[4] = {7.5f, 2.3f, 120.0f, 0.1042f};
        memcpy(k->zero_plane, zero_plane, sizeof zero_plane);
        k->const_shift = 200; k->accel[1] = 819;
        plug_in(k);
    }
    pthread_mutex_unlock(&lock);
}
#define LOCKED(what) do { pthread_mutex_lock(&lock); what; pthread_cond_broadcast(&changed); pthread_mutex_unlock(&lock); } while (0)
void emulated_serial(int i, const char *serial, const char *audio) {
    LOCKED(snprintf(kinects[i].serial, 64, "%s", serial); snprintf(kinects[i].audio_serial, 64, "%s", audio));
}
void emulated_model(int i, int model) { LOCKED(pull_out(&kinects[i]); kinects[i].model = model; plug_in(&kinects[i])); }
void emulated_bus(int i, int bus) { LOCKED(kinects[i].bus = bus); }
void emulated_factory(int i, const uint8_t *registration, const uint8_t *zero_plane, int start_lines, int const_shift) {
    LOCKED(memcpy(kinects[i].registration, registration, 116); memcpy(kinects[i].zero_plane, zero_plane, 16);
           kinects[i].start_lines = start_lines; kinects[i].const_shift = const_shift);
}
void emulated_plug(int i, int on) {
    LOCKED(if (on && !kinects[i].plugged) plug_in(&kinects[i]); if (!on && kinects[i].plugged) pull_out(&kinects[i]));
}
void emulated_motor_order(const int *order) { LOCKED(memcpy(motor_order, order, count * sizeof *order)); }
void emulated_busy(int i, int on) { LOCKED(kinects[i].busy = on); }
void emulated_restarts(int i, int looks) { LOCKED(kinects[i].restarts = looks); }
void emulated_no_hubs(int on) { LOCKED(no_hubs = on); }
void emulated_denied(int i, int on) { LOCKED(kinects[i].denied = on); }
void emulated_hang(int i, int what) { LOCKED(kinects[i].hang = what); }
void emulated_stall(int i, int on) { LOCKED(kinects[i].stalled = on); }
void emulated_no_bandwidth(int i, int on) { LOCKED(kinects[i].no_bandwidth = on); }
void emulated_kernel_driver(int i, int what) { LOCKED(kinects[i].kernel_driver = what); } /* 2: it does not let go */
void emulated_lose_every(int i, long nth) { LOCKED(kinects[i].lose_every = nth); }
void emulated_lose(int i, int first, int n) { LOCKED(kinects[i].lose_first = first; kinects[i].lose_count = n); }
void emulated_garbage(int i, int stream, int kind) { LOCKED(kinects[i].garbage[stream] = kind); }
void emulated_accel(int i, int x, int y, int z) { LOCKED(kinects[i].accel[0] = x; kinects[i].accel[1] = y; kinects[i].accel[2] = z); }
int emulated_led(int i) { return kinects[i].led; }
int emulated_led_alt(int i) { return kinects[i].led_alt; }
int emulated_tilt(int i) { return kinects[i].tilt; }
int emulated_register(int i, int reg) { return kinects[i].registers[reg & 0xfff]; }
int emulated_cmos(int i, int reg) { return kinects[i].cmos[reg & 0x1ff]; }
int emulated_open_handles(void) { return open_handles; }
int emulated_contexts(void) { return contexts; }
int emulated_transfers(void) { return live_transfers; }
int emulated_log(log_entry *into, int most) {
    int n = 0;
    LOCKED(for (int at = logged > LOG_LENGTH ? logged - LOG_LENGTH : 0; at < logged && n < most; at++) into[n++] = log_[at % LOG_LENGTH]);
    return n;
}

static int streams(const kinect *k, int s) {
    return k->plugged && k->owner && (s == DEPTH ? k->registers[6] == 2 : k->registers[5] == 1);
}

/* One packet on its way; returns 0 where the host had no transfer waiting for it. */
static int send_packet(kinect *k, int s, const uint8_t *data, int length, int64_t until_ns) {
    while (streams(k, s) && !k->owner->pending[s].first && now_ns() < until_ns) wait_until(until_ns);
    if (!streams(k, s) || !k->owner->pending[s].first) return 0;
    transfer *x = k->owner->pending[s].first;
    struct libusb_iso_packet_descriptor *d = &x->t.iso_packet_desc[x->filled];
    uint8_t *place = x->t.buffer;
    for (int i = 0; i < x->filled; i++) place += x->t.iso_packet_desc[i].length;
    if (length > (int)d->length) length = d->length;
    memcpy(place, data, length);
    d->actual_length = length;
    d->status = LIBUSB_TRANSFER_COMPLETED;
    if (++x->filled == x->t.num_iso_packets) complete(k->owner, take(&k->owner->pending[s]), LIBUSB_TRANSFER_COMPLETED);
    return 1;
}
static void flush(kinect *k, int s) { /* what is begun is filled up with empty packets */
    transfer *x = k->owner ? k->owner->pending[s].first : NULL;
    if (!x || !x->filled) return;
    for (; x->filled < x->t.num_iso_packets; x->filled++) x->t.iso_packet_desc[x->filled].actual_length = 0;
    complete(k->owner, take(&k->owner->pending[s]), LIBUSB_TRANSFER_COMPLETED);
}

/* Sends a picture; returns the packets that were lost on the way, or -1 where the stream is off. */
static int push(int i, int s, const uint8_t *picture, uint32_t ticks, int wait_ms) {
    uint8_t packet[2048];
    int lost = 0, packets = (FRAME[s] + PACKET[s] - HEADER - 1) / (PACKET[s] - HEADER);
    int64_t until_ns = now_ns() + wait_ms * 1000000LL;
    pthread_mutex_lock(&lock);
    kinect *k = &kinects[i];
    if (!streams(k, s)) { pthread_mutex_unlock(&lock); return -1; }
    for (int p = 0; p < packets; p++) {
        int length = p < packets - 1 ? PACKET[s] - HEADER : FRAME[s] - p * (PACKET[s] - HEADER);
        uint8_t end = p == 0 ? 1 : p == packets - 1 ? 5 : 2;
        uint8_t header[HEADER] = {'R', 'B', 0, FLAG[s] | end, 0, k->seq[s]++, 0, 0};
        memcpy(header + 8, &ticks, 4);
        memcpy(packet, header, HEADER);
        memcpy(packet + HEADER, picture + p * (PACKET[s] - HEADER), length);
        k->sent++;
        int in_span = s == DEPTH && p >= k->lose_first && p < k->lose_first + k->lose_count;
        if (in_span || (k->lose_every && k->sent % k->lose_every == 0)) { lost++; continue; }
        if (k->garbage[s] == 1 && p % 7 == 3) memset(packet, p, sizeof packet);           /* no header at all */
        if (k->garbage[s] == 2 && p % 11 == 5) packet[3] = 0x55;                           /* an unknown flag */
        if (k->garbage[s] == 3 && p % 13 == 6) length /= 2;                                /* half of it */
        if (k->garbage[s] == 4) for (int b = 0; b < HEADER; b++) packet[b] = rand();       /* nothing but noise */
        if (!send_packet(k, s, packet, length + HEADER, until_ns)) { lost++; k->late++; }
    }
    if (s == DEPTH) k->lose_count = 0;
    flush(k, s);
    pthread_mutex_unlock(&lock);
    return lost;
}
int emulated_push_depth(int i, const uint16_t *raw, uint32_t ticks, int wait_ms) {
    uint8_t *packed = malloc(FRAME[DEPTH]), *to = packed;
    for (const uint16_t *f = raw; f < raw + PIXELS; f += 8, to += 11) { /* eight values of 11 bits, high bits first */
        uint64_t a = (uint64_t)f[0] << 33 | (uint64_t)f[1] << 22 | (uint64_t)f[2] << 11 | f[3];
        uint64_t b = (uint64_t)f[4] << 33 | (uint64_t)f[5] << 22 | (uint64_t)f[6] << 11 | f[7];
        unsigned __int128 all = (unsigned __int128)a << 44 | b;
        for (int n = 0; n < 11; n++) to[n] = (uint8_t)(all >> (80 - 8 * n));
    }
    int lost = push(i, DEPTH, packed, ticks, wait_ms);
    free(packed);
    return lost;
}
int emulated_push_video(int i, const uint8_t *bayer, uint32_t ticks, int wait_ms) { return push(i, VIDEO, bayer, ticks, wait_ms); }

/* The camera's commands */

static void reply(kinect *k, const uint16_t *request, const void *data, int length) {
    uint16_t header[4] = {0x4252, (uint16_t)(length / 2), request[2], request[3]};
    memcpy(k->reply, header, 8);
    memcpy(k->reply + 8, data, length);
    k->reply_length = 8 + length;
}
static void command(kinect *k, const uint8_t *data) {
    uint16_t q[8];
    uint8_t answer[0x200] = {0};
    uint16_t *words = (uint16_t *)answer;
    memcpy(q, data, sizeof q);
    const uint16_t *arguments = q + 4;
    switch (q[2]) {
    case 0x02: words[1] = k->registers[arguments[0] & 0xfff]; reply(k, q, answer, 4); break;
    case 0x03:
        k->registers[arguments[0] & 0xfff] = arguments[1];
        note(k, arguments[0], arguments[1]);
        reply(k, q, answer, 2);
        pthread_cond_broadcast(&changed);
        break;
    case 0x04: memcpy(answer + 94, k->zero_plane, 16); reply(k, q, answer, k->model == MODEL_1414 ? 322 : 334); break;
    case 0x16:
        if (arguments[0] == 0x40) { memcpy(answer + 2, k->registration, 116); reply(k, q, answer, 118); }
        else if (arguments[0] == 0x41) { words[1] = k->start_lines; reply(k, q, answer, 8); }
        else { words[1] = k->const_shift; reply(k, q, answer, 4); }
        break;
    case 0x95: {
        int reg = arguments[1] & 0x1ff;
        if (arguments[1] & 0x8000) { k->cmos[reg] = arguments[2]; note(k, 0x10000 | reg, arguments[2]); }
        words[0] = arguments[0]; words[1] = arguments[1]; words[2] = k->cmos[reg];
        reply(k, q, answer, 6);
        break;
    }
    default: reply(k, q, answer, 2);
    }
}

/* libusb */

int libusb_init(libusb_context **ctx) { *ctx = calloc(1, sizeof **ctx); LOCKED(contexts++); return 0; }
void libusb_exit(libusb_context *ctx) { LOCKED(contexts--); free(ctx); }
const char *libusb_error_name(int code) {
    switch (code) {
    case LIBUSB_ERROR_IO: return "LIBUSB_ERROR_IO";
    case LIBUSB_ERROR_ACCESS: return "LIBUSB_ERROR_ACCESS";
    case LIBUSB_ERROR_NO_DEVICE: return "LIBUSB_ERROR_NO_DEVICE";
    case LIBUSB_ERROR_BUSY: return "LIBUSB_ERROR_BUSY";
    case LIBUSB_ERROR_PIPE: return "LIBUSB_ERROR_PIPE";
    case LIBUSB_ERROR_NO_MEM: return "LIBUSB_ERROR_NO_MEM";
    default: return "LIBUSB_ERROR_OTHER";
    }
}

static int plugged(const libusb_device *d) { return d->kinect->plugged && d->generation == d->kinect->generation; }
static int is_camera(const libusb_device *d) { return d->product == CAMERA_1414 || d->product == CAMERA_K4W; }
static libusb_device *part(libusb_context *ctx, kinect *k, int which) { /* one of each for a context, until it is unplugged */
    libusb_device **d = &ctx->devices[k->index][which];
    if (!*d || (*d)->generation != k->generation) {
        int k4w = k->model == MODEL_K4W;
        int products[PARTS] = {0, k4w ? CAMERA_K4W : CAMERA_1414, k4w ? AUDIO_K4W : AUDIO_1414, MOTOR};
        libusb_device made = {ctx, k, products[which], k->generation, which == HUB ? NULL : part(ctx, k, HUB)};
        *d = malloc(sizeof made); /* handles may hold it for ever, so it is never freed */
        **d = made;
    }
    return *d;
}
ssize_t libusb_get_device_list(libusb_context *ctx, libusb_device ***list) {
    libusb_device **all = calloc(MOST_DEVICES + 1, sizeof *all);
    ssize_t n = 0;
    pthread_mutex_lock(&lock);
    for (int i = 0; i < count; i++)
        for (int which = HUB; kinects[i].plugged && which <= AUDIO; which++)
            if (which != AUDIO || !kinects[i].away || kinects[i].away-- < 0) all[n++] = part(ctx, &kinects[i], which);
    for (int i = 0; i < count; i++) {
        kinect *k = &kinects[motor_order[i]];
        if (k->plugged && k->model == MODEL_1414) all[n++] = part(ctx, k, MOTOR_);
    }
    pthread_mutex_unlock(&lock);
    *list = all;
    return n;
}
void libusb_free_device_list(libusb_device **list, int unref) { (void)unref; free(list); }
libusb_device *libusb_get_parent(libusb_device *d) { return no_hubs ? NULL : d->parent; }
uint8_t libusb_get_bus_number(libusb_device *d) { return d->kinect->bus; }
int libusb_get_device_descriptor(libusb_device *d, struct libusb_device_descriptor *into) {
    memset(into, 0, sizeof *into);
    into->bLength = 18; into->bDescriptorType = 1; into->bcdUSB = 0x200;
    into->idVendor = !d->parent ? 0x0409 : MICROSOFT; into->idProduct = d->product;
    into->bDeviceClass = d->parent ? 0 : 9;
    into->bcdDevice = d->kinect->model == MODEL_1414 ? 267 : 0x0115;
    into->iSerialNumber = !d->parent || d->product == MOTOR ? 0 : 3;
    into->bNumConfigurations = 1;
    return 0;
}
int libusb_get_active_config_descriptor(libusb_device *d, struct libusb_config_descriptor **into) {
    (void)d;
    *into = calloc(1, sizeof **into);
    (*into)->bNumInterfaces = 1;
    return 0;
}
void libusb_free_config_descriptor(struct libusb_config_descriptor *d) { free(d); }
int libusb_get_max_iso_packet_size(libusb_device *d, unsigned char endpoint) { (void)d; return endpoint == ENDPOINT[DEPTH] ? PACKET[DEPTH] : PACKET[VIDEO]; }

/* Only what waits for this device waits; as long as it hangs, nothing else does. */
static int hanging(kinect *k, int what) {
    int was = k->hang == what;
    while (k->hang == what) wait_until(now_ns() + 100000000LL);
    return was;
}

int libusb_open(libusb_device *d, libusb_device_handle **into) {
    int result = LIBUSB_ERROR_NO_DEVICE;
    pthread_mutex_lock(&lock);
    if (plugged(d)) result = d->kinect->denied ? LIBUSB_ERROR_ACCESS : 0;
    if (!result) {
        *into = calloc(1, sizeof **into);
        (*into)->dev = d;
        (*into)->ctx = d->ctx;
        open_handles++;
    }
    pthread_mutex_unlock(&lock);
    return result;
}
void libusb_close(libusb_device_handle *h) {
    pthread_mutex_lock(&lock);
    if (h->dev->kinect->owner == h) h->dev->kinect->owner = NULL;
    open_handles--;
    pthread_mutex_unlock(&lock);
    free(h);
}
libusb_device *libusb_get_device(libusb_device_handle *h) { return h->dev; }
int libusb_get_string_descriptor_ascii(libusb_device_handle *h, uint8_t index, unsigned char *data, int length) {
    int result;
    pthread_mutex_lock(&lock);
    kinect *k = h->dev->kinect;
    if (k->hang == HANG_CONTROL) { pthread_mutex_unlock(&lock); sleep(1); return LIBUSB_ERROR_TIMEOUT; } /* as libusb does */
    const char *text = index != 3 ? "Xbox NUI" : is_camera(h->dev) ? k->serial : k->audio_serial;
    result = plugged(h->dev) ? snprintf((char *)data, length, "%s", text) : LIBUSB_ERROR_NO_DEVICE;
    pthread_mutex_unlock(&lock);
    return result;
}
int libusb_claim_interface(libusb_device_handle *h, int number) {
    (void)number;
    int result = 0;
    pthread_mutex_lock(&lock);
    kinect *k = h->dev->kinect;
    if (!plugged(h->dev)) result = LIBUSB_ERROR_NO_DEVICE;
    else if (is_camera(h->dev)) {
        if (k->busy || (k->owner && k->owner != h) || k->kernel_driver) result = LIBUSB_ERROR_BUSY;
        else k->owner = h;
    }
    h->claimed = !result;
    pthread_mutex_unlock(&lock);
    return result;
}
int libusb_release_interface(libusb_device_handle *h, int number) {
    (void)number;
    LOCKED(h->claimed = 0; if (h->dev->kinect->owner == h) h->dev->kinect->owner = NULL);
    return 0;
}
int libusb_set_interface_alt_setting(libusb_device_handle *h, int number, int setting) { (void)number; (void)setting; return plugged(h->dev) ? 0 : LIBUSB_ERROR_NO_DEVICE; }
int libusb_kernel_driver_active(libusb_device_handle *h, int number) { (void)number; return is_camera(h->dev) && h->dev->kinect->kernel_driver; }
int libusb_detach_kernel_driver(libusb_device_handle *h, int number) {
    (void)number;
    if (h->dev->kinect->kernel_driver == 2) return LIBUSB_ERROR_OTHER;
    LOCKED(h->dev->kinect->kernel_driver = 0);
    return 0;
}
int libusb_attach_kernel_driver(libusb_device_handle *h, int number) { (void)h; (void)number; return 0; }
int libusb_reset_device(libusb_device_handle *h) {
    int result = plugged(h->dev) ? 0 : LIBUSB_ERROR_NO_DEVICE;
    LOCKED(h->dev->kinect->away = h->dev->kinect->restarts);
    return result;
}

static int camera_control(kinect *k, uint8_t type, unsigned char *data, uint16_t length) {
    if (type == 0x40) { command(k, data); return length; }
    if (k->hang == HANG_EMPTY) return 0;
    int n = k->reply_length < length ? k->reply_length : length;
    memcpy(data, k->reply, n);
    k->reply_length = 0;
    return n;
}
static int motor_control(kinect *k, uint8_t request, uint16_t value, unsigned char *data) {
    if (request == 0x06) { k->led = value; note(k, 0x20006, value); return 0; }
    if (request == 0x31) { k->tilt = (int16_t)value; note(k, 0x20031, value); return 0; }
    if (request != 0x32) return LIBUSB_ERROR_PIPE;
    memset(data, 0, 10);
    for (int a = 0; a < 3; a++) { data[2 + 2 * a] = (uint16_t)k->accel[a] >> 8; data[3 + 2 * a] = k->accel[a] & 0xff; }
    data[8] = (uint8_t)k->tilt;
    return 10;
}
int libusb_control_transfer(libusb_device_handle *h, uint8_t type, uint8_t request, uint16_t value, uint16_t index,
                            unsigned char *data, uint16_t length, unsigned int timeout) {
    (void)index;
    int result;
    kinect *k = h->dev->kinect;
    if (k->hang == HANG_EMPTY) usleep(1000);
    pthread_mutex_lock(&lock);
    if (timeout && k->hang == HANG_CONTROL) { pthread_mutex_unlock(&lock); usleep(timeout * 1000); return LIBUSB_ERROR_TIMEOUT; }
    hanging(k, HANG_CONTROL);
    if (!plugged(h->dev)) result = LIBUSB_ERROR_NO_DEVICE;
    else if (k->stalled) result = LIBUSB_ERROR_PIPE;
    else if (h->dev->product == MOTOR) result = motor_control(k, request, value, data);
    else result = camera_control(k, type, data, length);
    pthread_mutex_unlock(&lock);
    return result;
}
int libusb_bulk_transfer(libusb_device_handle *h, unsigned char endpoint, unsigned char *data, int length, int *moved, unsigned int timeout) {
    (void)timeout;
    *moved = 0;
    if (!plugged(h->dev)) return LIBUSB_ERROR_NO_DEVICE;
    if (endpoint & 0x80) {
        uint32_t answer[3] = {0x0a6fe000, 0, 0};
        *moved = length < 12 ? length : 12;
        memcpy(data, answer, *moved);
    } else {
        *moved = length;
        if (length >= 20) { uint32_t q[5]; memcpy(q, data, 20); LOCKED(h->dev->kinect->led_alt = q[4]; note(h->dev->kinect, 0x30000 | (q[3] & 0xffff), q[4])); }
    }
    return 0;
}

struct libusb_transfer *libusb_alloc_transfer(int packets) {
    transfer *x = calloc(1, sizeof *x + packets * sizeof(struct libusb_iso_packet_descriptor));
    x->t.num_iso_packets = packets;
    LOCKED(live_transfers++);
    return &x->t;
}
void libusb_free_transfer(struct libusb_transfer *t) { LOCKED(live_transfers--); free(of(t)); }
static int stream_of(const struct libusb_transfer *t) { return t->endpoint == ENDPOINT[DEPTH] ? DEPTH : VIDEO; }
int libusb_submit_transfer(struct libusb_transfer *t) {
    int result = 0;
    pthread_mutex_lock(&lock);
    libusb_device_handle *h = t->dev_handle;
    if (!plugged(h->dev)) result = LIBUSB_ERROR_NO_DEVICE;
    else if (h->dev->kinect->no_bandwidth) result = LIBUSB_ERROR_IO;
    else {
        of(t)->filled = 0;
        append(&h->pending[stream_of(t)], of(t));
        pthread_cond_broadcast(&changed);
    }
    pthread_mutex_unlock(&lock);
    return result;
}
int libusb_cancel_transfer(struct libusb_transfer *t) {
    int result = LIBUSB_ERROR_NOT_FOUND;
    LOCKED(if (remove_from(&t->dev_handle->pending[stream_of(t)], of(t))) {
        complete(t->dev_handle, of(t), LIBUSB_TRANSFER_CANCELLED);
        result = 0;
    });
    return result;
}

static int context_hangs(libusb_context *ctx) {
    for (int i = 0; i < count; i++)
        if (kinects[i].hang == HANG_EVENTS && kinects[i].owner && kinects[i].owner->ctx == ctx) return 1;
    return 0;
}
int libusb_handle_events_timeout(libusb_context *ctx, struct timeval *tv) {
    int64_t until_ns = now_ns() + tv->tv_sec * 1000000000LL + tv->tv_usec * 1000LL;
    pthread_mutex_lock(&lock);
    while (context_hangs(ctx)) wait_until(now_ns() + 100000000LL);
    while (!ctx->done.first && now_ns() < until_ns) wait_until(until_ns);
    fifo done = ctx->done;
    ctx->done.first = ctx->done.last = NULL;
    pthread_mutex_unlock(&lock);
    for (transfer *x; (x = take(&done));) x->t.callback(&x->t);
    return 0;
}
int libusb_handle_events(libusb_context *ctx) {
    struct timeval minute = {60, 0};
    return libusb_handle_events_timeout(ctx, &minute);
}
