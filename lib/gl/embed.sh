#!/bin/sh
# embed.sh FILE...: writes shader sources as C strings: `const char gl_source_NAME[]` for NAME.glsl.
printf '#include "gl/shader_sources.h"\n'
for file; do
    name=${file##*/}
    printf '\nconst char gl_source_%s[] =\n' "${name%.glsl}"
    sed -e 's/\\/\\\\/g' -e 's/"/\\"/g' -e 's/^/    "/' -e 's/$/\\n"/' "$file"
    printf '    ;\n'
done
