// refresh.c: runs a found case again; see property.h.
#include "property/property.h"

#include <stdlib.h>

bool violation_refresh_counted(const Properties *properties, size_t property, double deadline, Found *found,
                               uint64_t *problems) {
    Violation *violations = memory_calloc((properties->count + 1) * sizeof *violations);
    Attempt attempt = {.properties = properties,
                       .values = found->values,
                       .only = (int64_t)property,
                       .deadline = deadline,
                       .violations = violations};
    bool violated = attempt_run(&attempt) && violations[property].found;
    found->tries++;
    *problems = attempt.problems;
    if (violated) {
        violation_free(&found->violation);
        found->violation = violations[property];
        violations[property] = (Violation){0};
    }
    for (size_t i = 0; i < properties->count; i++)
        violation_free(&violations[i]);
    attempt_free(&attempt);
    free(violations);
    return violated;
}

bool violation_refresh(const Properties *properties, size_t property, double deadline, Found *found) {
    uint64_t problems = 0;
    return violation_refresh_counted(properties, property, deadline, found, &problems);
}
