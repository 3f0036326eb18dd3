#!/bin/sh
# embed.sh FILE...: writes shader sources as C strings: `const char gl_source_NAME[]` for NAME.glsl. A line
# `#include "gl/colour_formulas.h"` is replaced by the macros in that file.
formulas=$(dirname "$0")/colour_formulas.h
printf '#include "gl/shader_sources.h"\n'
for file; do
    name=${file##*/}
    printf '\nconst char gl_source_%s[] =\n' "${name%.glsl}"
    awk -v formulas="$formulas" '
        !/^#include/ { print; next }
        { while ((getline < formulas) > 0) if (/^#define/) print }' "$file" |
        sed -e 's/\\/\\\\/g' -e 's/"/\\"/g' -e 's/^/    "/' -e 's/$/\\n"/'
    printf '    ;\n'
done
