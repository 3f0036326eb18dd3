# attr_names.awk: prints a row NAME(ID, "name") for each attribute name in schema_list.h and the lists that it includes.
/^ *(ATTR|ALIAS)\(/ {
    split($0, fields, /[(, ]+/)
    id = fields[$0 ~ /^ / ? 4 : 3]
    if (!seen[id]++)
        printf "NAME(%s, \"%s\")\n", id, tolower(id)
}
