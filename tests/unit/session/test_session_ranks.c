// test_session_ranks.c: tests that several ranks give the same results as one process, bit for bit. In these tests, the
// ranks are threads that communicate through queues. argv[1..]: folders of scripts.
#include "petri-inspect.h"
#include "petri-ranks.h"
#include "player.h"
#include "scripts.h"

#include <pthread.h>

enum { FRAMES = 6, SILENT_FRAMES = 4, SOME_RANKS = 5, MAX_RANKS = 7 };

// A message in a queue.
typedef struct Message {
    struct Message *next;
    size_t count;
    double numbers[];
} Message;

typedef struct Queue {
    Message *first;
    Message **end;
} Queue;

typedef struct World {
    pthread_mutex_t mutex;
    pthread_cond_t arrived;
    Queue queues[MAX_RANKS][MAX_RANKS]; // by sender and receiver
    int count;
    const char *file; // NULL: the script is `text`
    const char *text;
    int frames;
    bool silent;    // true: states are not hashed, because hashes of large systems are slow
    double *common; // memory shared by the ranks
} World;

typedef struct Rank {
    World *world;
    int number;
    Notebook output;
    uint64_t sent;
    PetriRankStats stats; // statistics of the first system
} Rank;

static void send(void *host, int to, const double *numbers, size_t runs, size_t length, size_t stride) {
    Rank *rank = host;
    Queue *queue = &rank->world->queues[rank->number][to];
    Message *parcel = malloc(sizeof *parcel + runs * length * sizeof *numbers);
    parcel->next = NULL;
    parcel->count = runs * length;
    for (size_t k = 0; k < runs; k++)
        memcpy(parcel->numbers + k * length, numbers + k * stride, length * sizeof *numbers);
    pthread_mutex_lock(&rank->world->mutex);
    *queue->end = parcel;
    queue->end = &parcel->next;
    pthread_cond_broadcast(&rank->world->arrived);
    pthread_mutex_unlock(&rank->world->mutex);
    rank->sent++;
}

static void receive(void *host, int from, double *numbers, size_t runs, size_t length, size_t stride) {
    Rank *rank = host;
    Queue *queue = &rank->world->queues[from][rank->number];
    pthread_mutex_lock(&rank->world->mutex);
    while (!queue->first)
        pthread_cond_wait(&rank->world->arrived, &rank->world->mutex);
    Message *parcel = queue->first;
    queue->first = parcel->next;
    if (!queue->first)
        queue->end = &queue->first;
    pthread_mutex_unlock(&rank->world->mutex);
    if (parcel->count != runs * length)
        abort(); // the ranks' sequences of operations differ
    for (size_t k = 0; k < runs; k++)
        memcpy(numbers + k * stride, parcel->numbers + k * length, length * sizeof *numbers);
    free(parcel);
}

static void broadcast(void *host, int from, double *numbers, size_t runs, size_t length, size_t stride) {
    Rank *rank = host;
    if (rank->number != from)
        receive(host, from, numbers, runs, length, stride);
    for (int to = 0; rank->number == from && to < rank->world->count; to++)
        if (to != from)
            send(host, to, numbers, runs, length, stride);
}

static void allgatherv(void *host, double *numbers, const size_t *starts) {
    const Rank *rank = host;
    for (int from = 0; from < rank->world->count; from++) {
        size_t length = starts[from + 1] - starts[from];
        broadcast(host, from, numbers + starts[from], 1, length, length);
    }
}

static void allreduce_max(void *host, double *numbers, size_t count) {
    const Rank *rank = host;
    double *others = malloc(count * sizeof *others);
    for (int from = 1; rank->number == 0 && from < rank->world->count; from++) {
        receive(host, from, others, 1, count, count);
        for (size_t i = 0; i < count; i++)
            numbers[i] = others[i] > numbers[i] ? others[i] : numbers[i];
    }
    if (rank->number > 0)
        send(host, 0, numbers, 1, count, count);
    broadcast(host, 0, numbers, 1, count, count);
    free(others);
}

// Allocates new memory in each call, without the data of the previous frame.
static double *alloc_shared(void *host, size_t count) {
    const Rank *rank = host;
    double all = 0, address = 0;
    allreduce_max(host, &all, 1); // wait until no rank reads the old memory any more
    if (rank->number == 0) {
        free(rank->world->common);
        rank->world->common = malloc(count * sizeof *rank->world->common);
    }
    broadcast(host, 0, &address, 1, 1, 1);
    return rank->world->common;
}

static bool in_common; // true if the ranks share memory

// Writes a checksum of the forces in the last step to the notebook.
static void note_forces(PetriSession *session, Notebook *book) {
    PetriSystem system;
    uint64_t sum = 0;
    if (!petri_system(session, 0, &system, sizeof system) || !system.force.data)
        return;
    for (uint32_t i = 0; i < system.particle_count; i++)
        for (uint32_t k = 0; k < system.dimensions; k++) {
            uint64_t bits;
            memcpy(&bits, &system.force.data[i * system.force.stride + k], sizeof bits);
            sum = sum * 31 + bits;
        }
    char line[40];
    note(book, line, (size_t)snprintf(line, sizeof line, "forces %016llx\n", (unsigned long long)sum));
}

static void *run_rank(void *context) {
    Rank *rank = context;
    const World *world = rank->world;
    Player player = {0};
    PetriRanks ranks = {sizeof ranks,
                        rank->number,
                        world->count,
                        1,
                        rank,
                        send,
                        receive,
                        broadcast,
                        allgatherv,
                        allreduce_max,
                        in_common ? alloc_shared : NULL};
    PetriOptions options = player_options(&player);
    options.threads = 1;
    options.ranks = &ranks;
    options.keep_forces = true;
    player_open_with(&player, &options);
    bool going = (world->file ? petri_load(player.session, world->file)
                              : petri_load_text(player.session, "text", world->text, PETRI_NUL_TERMINATED)) == PETRI_OK;
    note(&rank->output, "", 0);
    for (int frame = 0; going && frame < world->frames; frame++) {
        going = petri_step(player.session) == PETRI_OK;
        if (!world->silent)
            petri_print(player.session, PETRI_PRINT_HASH, note, &rank->output);
    }
    note_forces(player.session, &rank->output);
    petri_rank_stats(player.session, 0, &rank->stats, sizeof rank->stats);
    player_close(&player);
    return NULL;
}

static PetriRankStats regions; // statistics of the last call of run_world, summed over its ranks

// Runs the script on `count` ranks. Returns the results of the first rank, and the number of messages in *sent.
static Notebook run_world(const char *file, const char *text, int count, int frames, uint64_t *sent) {
    World world = {.mutex = PTHREAD_MUTEX_INITIALIZER,
                   .arrived = PTHREAD_COND_INITIALIZER,
                   .count = count,
                   .file = file,
                   .text = text,
                   .frames = frames,
                   .silent = frames == SILENT_FRAMES};
    Rank ranks[MAX_RANKS] = {{0}};
    pthread_t threads[MAX_RANKS];
    for (int i = 0; i < count; i++)
        for (int k = 0; k < count; k++)
            world.queues[i][k].end = &world.queues[i][k].first;
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    pthread_attr_setstacksize(&attributes, (size_t)16 << 20);
    for (int i = 0; i < count; i++) {
        ranks[i] = (Rank){.world = &world, .number = i};
        assert_int_equal(pthread_create(&threads[i], &attributes, run_rank, &ranks[i]), 0);
    }
    *sent = 0;
    regions = (PetriRankStats){.decomposition = PETRI_DOMAIN_DECOMPOSED};
    for (int i = 0; i < count; i++) {
        pthread_join(threads[i], NULL);
        *sent += ranks[i].sent;
        regions.decomposition =
            ranks[i].stats.decomposition == PETRI_DOMAIN_DECOMPOSED ? regions.decomposition : PETRI_REPLICATED;
        regions.steps = ranks[i].stats.steps;
        regions.reductions = ranks[i].stats.reductions;
        regions.step_bytes += ranks[i].stats.step_bytes;
        regions.step_messages += ranks[i].stats.step_messages;
        regions.frame_bytes += ranks[i].stats.frame_bytes;
        regions.own += ranks[i].stats.own;
        regions.halo += ranks[i].stats.halo;
        assert_string_equal(ranks[i].output.text, ranks[0].output.text);
        if (i > 0)
            free(ranks[i].output.text);
    }
    pthread_attr_destroy(&attributes);
    free(world.common);
    return ranks[0].output;
}

static int scripts;
static uint64_t message_count;

static bool matches_single_rank(const char *file, const char *text, int frames) {
    uint64_t sent;
    bool all = true;
    Notebook alone = run_world(file, text, 1, frames, &sent);
    assert_int_equal(sent, 0);
    for (int count = 2; count < SOME_RANKS; count++) {
        Notebook together = run_world(file, text, count, frames, &sent);
        all = all && strcmp(alone.text, together.text) == 0;
        message_count += sent;
        free(together.text);
    }
    free(alone.text);
    return all;
}

static int differing;

static void check_script(const char *path) {
    scripts++;
    if (!matches_single_rank(path, NULL, FRAMES)) {
        differing++;
        print_error("%s: ranks differ\n", path);
    }
}

static void test_scripts_match_single_process(void **state) {
    (void)state;
    scripts_each(check_script);
    assert_true(scripts > 50);
    assert_int_equal(differing, 0);
    assert_true(message_count > 1000);
}

// The systems have many blocks of particles, the last of which is not full. They have one or several forces, and
// particles whose mass or charge is 0. The ranks compute triangles of pairs, and rectangles whose longer side is either
// one.
static void test_ranks_match_single_rank(void **state) {
    (void)state;
    static const char *const forces[] = {
        "    !gravity strength=5k\n",
        "    !electrostatic strength=100\n    !collision strength=50\n    !drag strength=0.01\n",
        "    !adhesion strength=10 overlap=0.3\n    !gravity strength=9 max_distance=40\n",
    };
    for (size_t i = 0; i < sizeof forces / sizeof *forces; i++)
        for (int dimensions = 1; dimensions <= 3; dimensions++) {
            char text[800];
            snprintf(
                text, sizeof text,
                "!physics state=:a dimensions=%d\n"
                "    for i in ..123\n"
                "        !particle id=i position=90*normal(:p)[i*%d..(i+1)*%d] charge=normal(:c)[i]*(i%%5>0) radius=4\n"
                "    !group\n"
                "        for i in 200..237\n"
                "            !particle id=i position=90*normal(:p)[i*%d..(i+1)*%d] charge=1 radius=3 mass=i%%3\n"
                "        !group\n"
                "            for i in 300..501\n"
                "                !particle id=i position=90*normal(:p)[i*%d..(i+1)*%d] charge=-1 radius=2\n"
                "%s",
                dimensions, dimensions, dimensions, dimensions, dimensions, dimensions, dimensions, forces[i]);
            uint64_t before = message_count;
            assert_true(matches_single_rank(NULL, text, FRAMES));
            assert_true(message_count > before + 100);
        }
}

// Forces with `theta` on groups of several sizes, with anchors, other forces and a limited range.
static void test_far_fields_match_single_rank(void **state) {
    (void)state;
    static const char *const forces[] = {
        "    !gravity strength=5 theta=0.7\n",
        "    !electrostatic strength=100 theta=1.2\n    !collision strength=50\n    !gravity theta=0.5\n",
        "    !gravity strength=9 max_distance=40 theta=0.9\n    !adhesion strength=10 overlap=0.3\n",
    };
    for (size_t i = 0; i < sizeof forces / sizeof *forces; i++)
        for (int dimensions = 2; dimensions <= 3; dimensions++) {
            char text[800];
            snprintf(text, sizeof text,
                     "!physics state=:a dimensions=%d resolution=1/120\n"
                     "    for i in ..1100\n"
                     "        !particle id=i position=90*normal(:p)[i*%d..(i+1)*%d] charge=normal(:c)[i]*(i%%5>0) "
                     "radius=1\n"
                     "    !anchor id=:a position=3 mass=50\n"
                     "    !group\n"
                     "        for i in 2000..3200\n"
                     "            !particle id=i position=90*normal(:p)[i*%d..(i+1)*%d] charge=1 mass=i%%3\n"
                     "%s",
                     dimensions, dimensions, dimensions, dimensions, dimensions, forces[i]);
            uint64_t before = message_count, sent;
            assert_true(matches_single_rank(NULL, text, 3));
            Notebook alone = run_world(NULL, text, 1, 3, &sent), together = run_world(NULL, text, MAX_RANKS, 3, &sent);
            assert_string_equal(alone.text, together.text);
            free(alone.text);
            free(together.text);
            assert_true(message_count > before);
        }
}

// Systems in which all forces have a limited range, and particles move far within a frame.
static const char *const reaching[] = {
    // all features: groups, ancestors, links longer than any range, a few large particles, single-particle forces
    "!physics state=:a dimensions=2 resolution=1/400\n"
    "    for i in ..500\n"
    "        !particle id=i position=60*uniform(:p)[2*i..2*i+2] velocity=20*normal(:v)[2*i..2*i+2] radius=1 mass=i%4 "
    "force=normal(:f)[2*i..2*i+2] ease=(0.2 if i%3 else 0)\n"
    "    for i in 500..503\n"
    "        !particle id=i position=60*uniform(:p)[2*i..2*i+2] radius=12 mass=9 charge=2\n"
    "    !anchor id=:a position=30;30 radius=4\n"
    "    !group\n"
    "        for i in 1000..1200\n"
    "            !particle id=i position=60*uniform(:p)[2*i..2*i+2] velocity=9;0 radius=0.5 charge=normal(:c)[i]\n"
    "        for i in 1000..1190\n"
    "            !distance from=i to=i+7 fixed=3 strength=4\n"
    "        !electrostatic strength=30 max_distance=5\n"
    "        !random strength=3\n"
    "        !group\n"
    "            for i in 2000..2300\n"
    "                !particle id=i position=60*uniform(:p)[2*i..2*i+2] radius=(i%3)/2\n"
    "            !adhesion strength=2 overlap=0.3\n"
    "            !field direction=1;2\n"
    "    for i in ..100\n"
    "        !distance from=5*i to=2000+i max=20 strength=0.5\n"
    "    !distance from=:a to=500 fixed=0\n"
    "    !collision strength=200\n"
    "    !random strength=5\n"
    "    !drag strength=0.01\n"
    "    !barrier position=0;0 normal=1;0 restitution=0.5\n"
    "    !barrier position=0;0 normal=0;1 min=1 strength=30\n"
    "    !barrier position=60;60 normal=-1;0\n"
    "    !barrier position=60;60 normal=0;-1\n",
    // three dimensions, forces that start and end, changing radii
    "!physics state=:a dimensions=3 resolution=1/300\n"
    "    for i in ..900\n"
    "        !particle id=i position=20*uniform(:p)[3*i..3*i+3] velocity=30*normal(:v)[3*i..3*i+3] "
    "radius=0.3+0.2*(i%40==0)*frame*frame charge=1\n"
    "    !electrostatic strength=3 max_distance=(1.5 if frame == 5 else 1)\n"
    "    !collision strength=50\n"
    "    !group\n"
    "        for i in 900..(1000 if frame > 4 else 1100)\n"
    "            !particle id=i position=20*uniform(:p)[3*i..3*i+3]\n"
    "        if frame > 1\n"
    "            !gravity strength=5 max_distance=1\n"
    "    !constant acceleration=0;0;-9\n",
    // many particles appear between two frames
    "!physics state=:a dimensions=2 resolution=1/300\n"
    "    for i in ..(200 if frame < 3 else 3000)\n"
    "        !particle id=i position=60*uniform(:p)[2*i..2*i+2] velocity=9*normal(:v)[2*i..2*i+2] radius=0.4\n"
    "    !collision strength=50\n",
    // one dimension; some positions are not finite, some particles appear, the speed is limited
    "!physics state=:a dimensions=1 resolution=1/500 speed_of_light=300\n"
    "    for i in ..800\n"
    "        !particle id=i position=3*normal(:p)[i]*(i%100+1) velocity=(1/0 if i%90==7 else 50*normal(:v)[i]) "
    "radius=1\n"
    "    for i in ..5\n"
    "        !particle id=1000+i position=0/0 radius=i\n"
    "    !collision strength=100 power=1.5\n"
    "    !buoyancy density=0.3\n",
    // too many neighbours for lists; some positions become NaN, and finite again in the next frame
    "!physics state=:a dimensions=1 resolution=1/300 speed_of_light=300\n"
    "    for i in ..900\n"
    "        !particle id=i position=200*uniform(:p)[i] velocity=(1/0 if i%90==7 else 5*normal(:v)[i]) charge=1\n"
    "    !electrostatic strength=0.01 max_distance=60\n",
    // more groups than neighbour lists; particles in groups without a list move fast; one frame without a maximum
    // distance
    "!physics state=:a dimensions=2 resolution=1/240\n"
    "    for g in ..10\n"
    "        !group\n"
    "            for i in 100*g..100*g+60\n"
    "                !particle id=i position=(i%3)*9+uniform(:p)[2*i..2*i+2] radius=0.3 "
    "velocity=(g>4)*200*normal(:v)[2*i..2*i+2]\n"
    "            !adhesion strength=9\n"
    "    !gravity strength=3 max_distance=(0 if frame == 3 else 3)\n",
    // columns in the order of neighbour lists, until a large particle appears or the global order is needed
    "!physics state=:a dimensions=2 resolution=1/300\n"
    "    for i in ..700\n"
    "        !particle id=i position=40*uniform(:p)[2*i..2*i+2] velocity=(15+i%5)*normal(:v)[2*i..2*i+2] mass=1+i%3 "
    "radius=(9 if i==30 and frame == 4 else 0.5+i%7/10) force=normal(:f)[2*i..2*i+2] ease=(0.2 if i%3 else 0)\n"
    "    for i in 700..720\n"
    "        !anchor id=i position=40*uniform(:p)[2*i..2*i+2]+frame/5 radius=1\n"
    "    !collision strength=100\n"
    "    !electrostatic strength=3 max_distance=2\n"
    "    !drag strength=0.01\n"
    "    if frame == 2\n"
    "        !random strength=2\n"
    "    if frame == 5\n"
    "        !distance from=1 to=600 fixed=3 strength=4\n"
    "    !barrier position=0;0 normal=1;0\n",
    // columns in the order of neighbour lists, all particles equal
    "!physics state=:a dimensions=3 resolution=1/300\n"
    "    for i in ..800\n"
    "        !particle id=i position=15*uniform(:p)[3*i..3*i+3] velocity=40*normal(:v)[3*i..3*i+3] radius=0.6\n"
    "    !collision strength=300\n"
    "    if frame == 3\n"
    "        !random strength=9\n",
    // two dimensions, with steps in a single pass
    "!physics state=:a dimensions=2 resolution=1/300\n"
    "    for i in ..1200\n"
    "        !particle id=i position=30*uniform(:p)[2*i..2*i+2] velocity=3*normal(:v)[2*i..2*i+2] radius=0.4 "
    "mass=(2 if frame == 3 else 1)\n"
    "    !collision strength=300\n"
    "    !constant acceleration=0;-5\n"
    "    !barrier position=0;0 normal=0;1\n"
    "    !barrier position=30;0 normal=-1;0\n",
};

static void test_domains_match_single_process(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof reaching / sizeof *reaching; i++) {
        uint64_t sent, halo = 0;
        Notebook alone = run_world(NULL, reaching[i], 1, FRAMES, &sent);
        static const int counts[] = {2, 3, SOME_RANKS};
        for (int c = 0; c < 2 * 3; c++) {
            int count = counts[c / 2];
            in_common = c % 2;
            Notebook together = run_world(NULL, reaching[i], count, FRAMES, &sent);
            assert_string_equal(alone.text, together.text);
            assert_int_equal(regions.decomposition, PETRI_DOMAIN_DECOMPOSED);
            assert_int_equal(in_common, regions.frame_bytes == 0);
            assert_true(regions.reductions > regions.steps + FRAMES); // particles have migrated within a frame
            halo += regions.halo;
            free(together.text);
        }
        assert_true(halo > regions.own / 100);
        free(alone.text);
        in_common = false;
    }
}

// The number of bytes sent per step grows with the surface of the regions, not with the number of particles.
static void test_traffic_grows_with_surface(void **state) {
    (void)state;
    static const int usual[] = {100, 200, 300}, all[] = {100, 316, 1000}; // number of discs along an edge
    const int *sides = getenv("SIZES") ? all : usual;
    for (int i = 0; i < 3; i++) {
        enum { RANKS = 4, POSITION = 2 * sizeof(double) };
        char text[400];
        uint64_t sent;
        snprintf(
            text, sizeof text,
            "!physics state=:a dimensions=2 resolution=1/600\n"
            "    for i in ..%d\n"
            "        !particle id=i radius=0.5 position=(i%%%d)*0.97;(i//%d)*0.97 velocity=3.6*normal(:v)[2*i..2*i+2]\n"
            "    !collision strength=36k\n",
            sides[i] * sides[i], sides[i], sides[i]);
        Notebook came = run_world(NULL, text, RANKS, SILENT_FRAMES, &sent);
        free(came.text);
        double steps = (double)regions.steps, halo = (double)regions.halo / steps;
        double bytes = (double)regions.step_bytes / steps, messages = (double)regions.step_messages / steps;
        // Each rank owns a quarter of the square and shares two edges. Its halo is as wide as a diameter plus the skin.
        double surface = RANKS * sides[i] * 1.3 / 0.97;
        print_message("%7d discs on %d ranks: %.0f in halos, %.0f bytes and %.1f messages a step\n",
                      sides[i] * sides[i], RANKS, halo, bytes, messages);
        assert_int_equal(regions.decomposition, PETRI_DOMAIN_DECOMPOSED);
        assert_int_equal(regions.own, regions.steps * (uint64_t)(sides[i] * sides[i]));
        assert_true(halo > 0.7 * surface && halo < 1.5 * surface);
        assert_true(bytes > halo * POSITION && bytes < 1.5 * halo * POSITION);
        assert_true(messages < 1.5 * RANKS * (RANKS - 1));
    }
}

// If no particle is near a particle of the other rank and none moves, a step costs each rank two numbers. The second
// system has too many neighbours for lists.
static void test_empty_halos_send_two_numbers(void **state) {
    (void)state;
    enum { RANKS = 2, MIN_FRAMES = 3, MAX_FRAMES = 4 };
    static const char *const resting[] = {
        "!physics state=:a dimensions=1 resolution=1/240\n"
        "    for i in ..100\n"
        "        !particle id=i radius=1 position=3*i+(i%2)*10k\n"
        "    !collision strength=9\n",
        "!physics state=:a dimensions=1 resolution=1/240\n"
        "    for i in ..900\n"
        "        !particle id=i position=i/10+(i%2)*10k\n"
        "    !electrostatic strength=0.01 max_distance=60\n",
    };
    for (size_t i = 0; i < sizeof resting / sizeof *resting; i++) {
        PetriRankStats stats[MAX_FRAMES + 1];
        for (int frames = MIN_FRAMES; frames <= MAX_FRAMES; frames++) {
            uint64_t sent;
            free(run_world(NULL, resting[i], RANKS, frames, &sent).text);
            stats[frames] = regions;
            assert_int_equal(regions.decomposition, PETRI_DOMAIN_DECOMPOSED);
            assert_int_equal(regions.halo, 0);
            assert_int_equal(regions.step_messages, 0);
        }
        uint64_t steps = stats[MAX_FRAMES].steps - stats[MIN_FRAMES].steps;
        assert_true(steps > 1);
        assert_int_equal(stats[MAX_FRAMES].reductions - stats[MIN_FRAMES].reductions, steps);
        assert_int_equal(stats[MAX_FRAMES].step_bytes - stats[MIN_FRAMES].step_bytes,
                         RANKS * steps * 2 * sizeof(double));
    }
}

TEST_GROUP(session_ranks) {
    if (argc < 2)
        return GROUP_SKIPPED; // no folders
    scripts_set_folders(argc, argv);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_scripts_match_single_process), cmocka_unit_test(test_ranks_match_single_rank),
        cmocka_unit_test(test_far_fields_match_single_rank), cmocka_unit_test(test_domains_match_single_process),
        cmocka_unit_test(test_traffic_grows_with_surface),   cmocka_unit_test(test_empty_halos_send_two_numbers)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
