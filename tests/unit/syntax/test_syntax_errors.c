// test_syntax_errors.c: texts of syntax errors: location, message and `| hint` (cli.md 3.5).
#include "parsing.h"

static void check_complaints(World *world, const char *const (*rows)[2], size_t count) {
    for (size_t i = 0; i < count; i++)
        assert_text(rows[i][0], complaints(world, str_from(rows[i][0])), rows[i][1]);
}

static void test_common_mistakes_have_hints(void **state) {
    static const char *const rows[][2] = {
        {"let x 5", "1:7: unexpected number 5, expected '='"},
        {"if x = 3\n    !a", "1:6: unexpected '=' | write '==' to compare, or 'let NAME=…' to name a value"},
        {"if x\n!a",
         "2:1: unexpected node !a, expected an indented block | add an indented block below the line above"},
        {"!a\n  !b\n    !c\n !d", "4:2: this line's indentation matches none of the lines above"},
        {"!a\n        !b\n\t  !c\n     !d", "4:6: this line's indentation matches none of the lines above | do not "
                                            "mix tabs and spaces: a tab counts as eight spaces"},
        {"foo(1, 2", "1:9: unexpected end of file | the parenthesis opened at line 1, column 4 is not closed"},
        {"foo(1, 2\n!b\n!c", "2:1: unexpected node !b | the parenthesis opened at line 1, column 4 is not closed"},
        {"(1;2\n", "1:5: unexpected end of file | the parenthesis opened at line 1, column 1 is not closed"},
        {"[1;2;3]", "1:1: unexpected '[' | separate vector elements with semicolons: 1;2;3"},
        {"1;2;",
         "1:5: unexpected end of line, expected an expression | remove the semicolon; a statement ends with its "
         "line"},
        {"!a x=", "1:6: unexpected end of line, expected an expression"},
        {"!a x=3,", "1:7: unexpected ',', expected end of line or '<<'"},
        {"'abc", "1:1: unterminated string | close the string on its line, or use ''' or \"\"\" for several lines"},
        {"\"abc", "1:1: unterminated string | close the string on its line, or use ''' or \"\"\" for several lines"},
        {"'''abc", "1:3: unterminated string | close the string on its line, or use ''' or \"\"\" for several lines"},
        {"'\\x4'", "1:1: '\\x' needs exactly 2 hexadecimal digits, '\\u' needs 4 and '\\U' needs 8"},
        {"1__0", "1:1: an underscore in a number must be between two digits"},
        {"1_", "1:1: an underscore in a number must be between two digits"},
        {"2**-1", "1:4: unexpected '-'"},
        {"a<b<c", "1:4: unexpected '<'"},
        {"!", "1:1: '!' must be directly followed by a name | write 'not' to negate a value"},
        {"#t", "1:1: unexpected tag #t | comments start with '--'"},
        {"# comment", "1:1: '#' must be directly followed by a name | comments start with '--'"},
        {"x = 3", "1:3: unexpected '=' | write '==' to compare, or 'let NAME=…' to name a value"},
        {"x == ", "1:6: unexpected end of line, expected an expression"},
        {"for x y\n    z", "1:7: unexpected name y, expected 'in'"},
        {"for in x\n    y", "1:8: unexpected name x, expected 'in'"},
        {"for x in\n    y", "1:9: unexpected end of line, expected an expression"},
        {"import a 'x.fl'", "1:10: unexpected string 'x.fl', expected 'from' | "
                            "write 'import NAME from \"FILE.fl\"' or '%include \"FILE.fl\"'"},
        {"func f\n    x", "1:7: unexpected end of line, expected '('"},
        {"func f(\n", "1:8: unexpected end of file, expected name or ')' | the parenthesis opened at line 1, column 7 "
                      "is not closed"},
        {"func f()\n!a",
         "2:1: unexpected node !a, expected an indented block | add an indented block below the line above"},
        {"let stable=1", "1:11: unexpected '=', expected name | "
                         "write '==' to compare, or 'let NAME=…' to name a value"},
        {"let", "1:4: unexpected end of line, expected name or 'stable'"},
        {"let x=1 2", "1:9: unexpected number 2 | separate vector elements with semicolons: 1;2;3"},
        {"%pragma fps", "1:12: unexpected end of line, expected an expression"},
        {"%pragma fps x", "1:13: unexpected name x"},
        {"x\n%pragma fps 3", "2:1: unexpected '%' | move the pragma to the top of the script, before all other lines"},
        {"%include", "1:9: unexpected end of line, expected an expression"},
        {"!a & !b", "1:4: unexpected character '&' (U+0026) | write 'A and B'"},
        {"a² ", "1:2: unexpected character '²' (U+00B2)"},
        {"a ? b", "1:3: unexpected character '?' (U+003F) | write 'A if TEST else B'"},
        {"!a \\ ", "1:4: a backslash outside a string must be the last character of its line"},
        {"\x01", "1:1: unexpected control character U+0001 | is this a text file?"},
        {"f(x=1, 2)", "1:8: unexpected number 2, expected name"},
        {"1 or func(x) x", "1:15: unexpected end of line, expected '='"},
        {"!a <<", "1:6: unexpected end of file, expected an expression"},
        {"!a << \n    !b", "2:5: unexpected indentation | the statement above cannot have an indented block"},
        {"x if y if z", "1:8: unexpected 'if'"},
        {"@f #t", "1:4: unexpected tag #t, expected name or end of line"},
        {"let a;=3", "1:7: unexpected '=', expected name | write '==' to compare, or 'let NAME=…' to name a value"},
        {"let 1=3", "1:5: unexpected number 1, expected name or 'stable'"},
        {")", "1:1: unexpected ')'"},
        {"!a)", "1:3: unexpected ')', expected end of line or '<<'"},
        {"f(1,)", "1:5: unexpected ')'"},
        {"not", "1:4: unexpected end of line, expected an expression"},
        {"1..2..3", "1:5: unexpected '..'"},
        {"$", "1:2: unexpected end of line, expected an expression"},
        {"x\n    y\n  z", "3:3: this line's indentation matches none of the lines above"},
        {"!a\n\ufeff"
         "!b",
         "2:1: a byte-order mark (U+FEFF) is allowed only at the start of a file"},
        // a byte-order mark at the start is ignored
        {"\ufeff!a )", "1:4: unexpected ')', expected end of line or '<<'"},
        {"!a\n\t!b\n    !c\n", "3:5: this line's indentation matches none of the lines above | do not mix tabs "
                               "and spaces: a tab counts as eight spaces"},
        // Only tabs and spaces at the start of lines are mixed indentation.
        {"!a\n    !b\tx=1\n  !c\n", "3:3: this line's indentation matches none of the lines above"},
        {"!a\n\t\t!b\n\t!c\n", "3:2: this line's indentation matches none of the lines above"},
        {"\t!a\n    !b\n  !c\n", "3:3: this line's indentation matches none of the lines above | do not mix tabs "
                                 "and spaces: a tab counts as eight spaces"},
        {"if x\n    !a (\nelse\n    !b )\n!c",
         "4:5: unexpected node !b | the parenthesis opened at line 2, column 8 is not closed"},
        {"let y=a for x = 3", "1:15: unexpected '=', expected 'in' | "
                              "write '==' to compare, or 'let NAME=…' to name a value"},
        // A comment at the error does not hide the hint.
        {"1;2;-- c",
         "1:5: unexpected end of line, expected an expression | remove the semicolon; a statement ends with its "
         "line"},
        {"!a x=#ff0000", "1:6: unexpected tag #ff0000 | a colour is r;g;b, each from 0 to 1: 1;0;0"},
        {"!a x=0x00ff00", "1:14: unexpected end of line, expected '=' | a colour is r;g;b, each from 0 to 1: 0;1;0"},
        // Of four tokens that could follow, the message lists none.
        {"!a x=y where z 3", "1:16: unexpected number 3"},
        {"!a x=a^b", "1:7: unexpected character '^' (U+005E) | write 'x**2' for a power"},
        {"for x of y\n    !a\n!b\n", "1:7: unexpected name of, expected 'in' | write a loop as 'for i in ..10'"},
    };
    check_complaints(*state, rows, COUNT_OF(rows));
}

// Each mistake gives one error, without follow-up errors.
static void test_each_mistake_is_reported_once(void **state) {
    static const char *const rows[][2] = {
        {"v[\n1]", "1:3: unexpected end of line, expected an expression\n"
                   "2:2: unexpected ']', expected end of line or '<<'"},
        {"!a\n!b x==1\n!c (2\n!d\n!e 'q\n!f",
         "2:5: unexpected '==', expected '='\n"
         "4:1: unexpected node !d | the parenthesis opened at line 3, column 4 is not closed\n"
         "5:4: unterminated string | close the string on its line, or use ''' or \"\"\" for several lines"},
        {"!a\n    !b\n  !c\n!d x==1\n", "3:3: this line's indentation matches none of the lines above\n"
                                        "4:5: unexpected '==', expected '='"},
        {"!a +\n!b *\n!c\n!d ]\n", "1:5: unexpected end of line, expected an expression\n"
                                   "2:5: unexpected end of line, expected an expression\n"
                                   "4:4: unexpected ']', expected end of line or '<<'"},
        {"!a x=1 2\n    !b\n        !c 3 4\n    !d\n!e 5 6\n",
         "1:8: unexpected number 2 | separate vector elements with semicolons: 1;2;3\n"
         "3:12: unexpected number 3\n"
         "5:4: unexpected number 5"},
        {"let a=(1;)\n    b=2\n    c=max(1, 2)\n    d=4\n!e )", "1:10: unexpected ')'\n"
                                                                "5:4: unexpected ')', expected end of line or '<<'"},
        // Lines below an open parenthesis that are further indented belong to the broken statement.
        {"let a=4+(1;\n    b=2\n    c=max(1, 2)\n        d=4\n    e=5\n\n!f )",
         "2:6: unexpected '=' | the parenthesis opened at line 1, column 9 is not closed\n"
         "7:4: unexpected ')', expected end of line or '<<'"},
        {"!a\n    !b x=(\n        !c\n        !d y=2 3\n    !e )\n!f )",
         "4:9: unexpected node !d | the parenthesis opened at line 2, column 10 is not closed\n"
         "5:8: unexpected ')', expected end of line or '<<'\n"
         "6:4: unexpected ')', expected end of line or '<<'"},
        // The grammar cannot recover from an error in a pragma.
        {"%pragma fps\n!a )\n", "1:12: unexpected end of line, expected an expression\n"
                                "2:4: unexpected ')', expected end of line or '<<'"},
        {"!a ! b\n!c 'x\n!d 1__0\n!e @\n",
         "1:4: '!' must be directly followed by a name | write 'not' to negate a value\n"
         "2:4: unterminated string | close the string on its line, or use ''' or \"\"\" for several lines\n"
         "3:4: an underscore in a number must be between two digits\n"
         "4:4: unexpected '@'"},
    };
    check_complaints(*state, rows, COUNT_OF(rows));
}

// Ill-formed UTF-8 gives a single error, whatever other errors the file has.
static void test_invalid_utf8_gives_one_error(void **state) {
    World *world = *state;
    static const struct {
        Str text;
        const char *wanted;
    } rows[] = {
        {{"!a\n!b \xff\n!c )", 12}, "2:4: the file is not valid UTF-8 | save the file as UTF-8; byte 0xFF is invalid"},
        {{"\xc0\x80", 2}, "1:1: the file is not valid UTF-8 | save the file as UTF-8; byte 0xC0 is invalid"},
        {{"'\xed\xa0\x80'", 5}, "1:2: the file is not valid UTF-8 | save the file as UTF-8; byte 0xED is invalid"},
        {{"-- \xe2\x82", 5}, "1:4: the file is not valid UTF-8 | save the file as UTF-8; byte 0xE2 is invalid"},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++)
        assert_text(rows[i].wanted, complaints(world, rows[i].text), rows[i].wanted);
}

// Two symbols with the same number are a load error (language.md L4.3).
static void test_symbol_collision_is_an_error(void **state) {
    World *world = *state;
    // Sets the number of a to the number of :b, because a real collision has a probability of 2^-52.
    Symbol *a = (Symbol *)(uintptr_t)symbol_intern(&world->symbols, STR("a"));
    a->number = symbol_number(STR("b"));
    assert_text("collision", complaints(world, STR("!x y=:a\n!x y=:b\n")),
                "2:6: this symbol has the same value as another symbol: rename one");
    assert_text("names are not symbols", complaints(world, STR("!b b=b #b\n")), "");
}

// At most 50 errors are stored. A file full of mistakes is still parsed to its end.
static void test_number_of_errors_is_limited(void **state) {
    World *world = *state;
    Text text = text_new(&world->arena);
    for (int i = 0; i < 5000; i++)
        text_add_c(&text, "!a )\n");
    Parsed parsed = parse_str(world, text_str(&text));
    assert_null(parsed.ast);
    assert_int_equal(parsed.diags.count, 50);
    assert_int_equal(parsed.diags.count + parsed.diags.dropped, 5000);
    diag_sink_free(&parsed.diags);
}

// Random mutations of a program that uses all constructs never crash the parser.
static void test_mutated_programs_never_crash(void **state) {
    World *world = *state;
    static const char program[] =
        "#!x\n%pragma fps 20\nlet a;b=1;2\nlet c=\n    !a x=1 #t\nfunc f(x, y=2)\n    x+y*2 where y=x\n"
        "for i;j in ..5|2, k in i\n    !q v=$(:a;i)[0] << f(1, y=2)\n        'a\\n'\nif a==1 and not b\n    @f x=1\n"
        "elif 1:30 < 2.5e3k\n    1 if 0 else 2 for z in '''x\ny'''\nelse\n    %include 'q'\nimport u from 'v'\n-- "
        "end\n";
    uint64_t seed = 11;
    char text[sizeof program];
    size_t accepted = 0;
    for (int round = 0; round < 20000; round++) {
        ArenaMark mark = arena_mark(&world->arena);
        memcpy(text, program, sizeof program);
        for (uint64_t changes = next_bits(&seed) % 4; changes > 0; changes--) {
            size_t at = next_bits(&seed) % (sizeof program - 1), from = next_bits(&seed) % (sizeof program - 1);
            text[at] = next_bits(&seed) % 3 ? program[from] : (char)(next_bits(&seed) % 127 + 1);
        }
        // Each mutation uses a new symbol table, because symbols must not outlive the arena mark.
        SymbolTable symbols = symbol_table_new(&world->arena);
        DiagSink diags = diag_sink_new(&world->arena, 50);
        const Source *source = source_new(&world->arena, STR("t"), STR("t"), (Str){text, sizeof program - 1});
        const Ast *ast = parse_program(&world->arena, &symbols, source, &diags);
        assert_true((ast != NULL) == (diags.error_count == 0));
        accepted += ast != NULL;
        for (uint32_t i = 0; i < diags.count; i++) {
            Text out = text_new(&world->arena);
            diag_format(&out, &diags.items[i], false);
            assert_true(diags.items[i].at.span.start <= source->text.len && out.len > 0);
        }
        diag_sink_free(&diags);
        symbol_table_free(&symbols);
        arena_rewind(&world->arena, mark);
    }
    assert_true(accepted > 1000 && accepted < 19000);
}

TEST_GROUP(syntax_errors) {
    const struct CMUnitTest tests[] = {
        WORLD_TEST(test_common_mistakes_have_hints),   WORLD_TEST(test_each_mistake_is_reported_once),
        WORLD_TEST(test_invalid_utf8_gives_one_error), WORLD_TEST(test_symbol_collision_is_an_error),
        WORLD_TEST(test_number_of_errors_is_limited),  WORLD_TEST(test_mutated_programs_never_crash),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
