// threads.c: see threads.h.
#include "physics/threads.h"

#ifdef _OPENMP
#include <omp.h>
#endif

void phys_parallel(int threads, void (*work)(void *context, int worker, int workers), void *context) {
#ifdef _OPENMP
    if (threads > 1) {
#pragma omp parallel num_threads(threads) default(none) shared(work, context)
        work(context, omp_get_thread_num(), omp_get_num_threads());
        return;
    }
#else
    (void)threads;
#endif
    work(context, 0, 1);
}
