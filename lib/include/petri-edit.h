// petri-edit.h: the part of libpetri for programs in which users write scripts: editors, prompts and checkers. It gives
// them the tokens, names and diagnostics of a script, help on the language, and a prompt. The rules of petri.h apply.
#ifndef PETRI_EDIT_H
#define PETRI_EDIT_H

#include "petri.h"

#ifdef __cplusplus
extern "C" {
#endif

// Checks a script without running it: compiles it with the current definitions, evaluates its first frame and reports
// all diagnostics, including those of drawing and hints about likely mistakes. Simulates, draws and writes nothing, and
// does not affect the loaded script. Returns PETRI_INVALID if the file cannot be read or is not a valid script.
PETRI_API PetriStatus petri_check(PetriSession *session, const char *file);

// Like petri_check, but checks a script in memory. `name` appears in messages. Returns PETRI_INVALID if the text is not
// a valid script.
PETRI_API PetriStatus petri_check_text(PetriSession *session, const char *name, const char *text, size_t length);

// Kinds of tokens that petri_tokenise finds.
typedef enum PetriTokenKind {
    PETRI_TOKEN_NAME,
    PETRI_TOKEN_KEYWORD, // a word used as a keyword; also %pragma and %include
    PETRI_TOKEN_NUMBER,  // also time codes
    PETRI_TOKEN_STRING,
    PETRI_TOKEN_SYMBOL,
    PETRI_TOKEN_NODE,
    PETRI_TOKEN_TAG,
    PETRI_TOKEN_OPERATOR, // also brackets and punctuation
    PETRI_TOKEN_COMMENT,  // without the end of the line; also a `#!` line
    PETRI_TOKEN_INVALID,  // a character that cannot start a token
    PETRI_TOKEN_NEWLINE,  // end of a statement or of a block's header; this token and the next two have no characters
    PETRI_TOKEN_INDENT,   // start of a block
    PETRI_TOKEN_DEDENT,   // end of a block
} PetriTokenKind;
typedef struct PetriToken {
    size_t size; // number of bytes of the struct that are filled
    PetriTokenKind kind;
    size_t start; // bytes from the start of the text
    size_t end;   // first byte after the token
} PetriToken;

// Receives a token. Must not call the session.
typedef void PetriTokenCallback(void *user_data, const PetriToken *token);

// Passes the tokens of a script to a callback, in order, for editors. Lines must end in LF, and there must be no byte
// order mark. Continues after syntax errors. Text that is not valid UTF-8 has no tokens. Returns PETRI_OK in both
// cases.
PETRI_API PetriStatus petri_tokenise(PetriSession *session, const char *text, size_t length,
                                     PetriTokenCallback *callback, void *user_data);

// Kinds of names that petri_bindings finds.
typedef enum PetriNameKind {
    PETRI_NAME_USE, // a use of a name; all other kinds bind a name
    PETRI_NAME_LET, // also `where`
    PETRI_NAME_FUNC,
    PETRI_NAME_PARAMETER,
    PETRI_NAME_LOOP,
    PETRI_NAME_IMPORT,
} PetriNameKind;

// A use or binding of a name. Positions are bytes from the start of the text. An end is the position after the last
// byte.
typedef struct PetriBinding {
    size_t size; // number of bytes of the struct that are filled
    PetriNameKind kind;
    size_t start;         // start of the name
    size_t end;           // end of the name
    size_t binding_start; // for a use: start of the name in its binding; SIZE_MAX: not bound in this text
    size_t scope_start;   // for a binding: start of the range in which the name is visible
    size_t scope_end;     // for a binding: end of that range
    size_t value_start;   // for a binding: start of the value, function or file name that is bound
    size_t value_end;     // for a binding: end of the value, function or file name
    bool is_sole;         // for a binding: true if the value is bound to this name only
    uint32_t depth;       // for a binding: number of enclosing blocks and functions
} PetriBinding;

// Receives a use or binding. Must not call the session.
typedef void PetriBindingCallback(void *user_data, const PetriBinding *name);

// Calls `callback` for each use and each binding of a name in a script, for editors. The text must follow the rules of
// petri_tokenise. Built-in functions, names of the engine and attributes are not included. Returns PETRI_OK even if the
// text has syntax errors.
PETRI_API PetriStatus petri_bindings(PetriSession *session, const char *text, size_t length,
                                     PetriBindingCallback *callback, void *user_data);

// A built-in function or host function, for help. The strings of a built-in function are static. Those of a host
// function are valid as long as the session.
typedef struct PetriBuiltin {
    const char *name;
    const char *parameters;
    const char *help;
} PetriBuiltin;

// Gets a built-in function by number. Returns false past the last.
PETRI_API bool petri_builtin(size_t index, PetriBuiltin *builtin, size_t size);

// Gets, by number, a function that the host added with petri_add_function. Returns false past the last.
PETRI_API bool petri_host_function(const PetriSession *session, size_t number, PetriBuiltin *function, size_t size);

// A kind of node that petri interprets, for help and completion. The strings are static.
typedef struct PetriNodeKind {
    const char *name; // without the `!`
    const char *area; // "physics", "canvas" or "canvas3d"; `group` exists in all three
    const char *help;
    // Formula of a force, else "". It has one or more lines `F = …`, which may end with `if` and a condition. The first
    // of these lines applies whose condition holds or that has no condition. Lines before them define names. A positive
    // F pushes the particles of a pair apart. The unit of F is mass·length/time², in the units of the script. n: number
    // of dimensions; δ: time step; l: distance between the particles of a pair; s: distance from the barrier. r, m, q,
    // v: radius, mass, charge and velocity of the particle; with index 1 or 2, those of the first or second particle of
    // the pair.
    const char *formula;
    const char *synonyms; // names that other programs have for it, separated by spaces, such as "circle disc"; or ""
} PetriNodeKind;

// An attribute of a kind of node. The strings are static.
typedef struct PetriNodeAttribute {
    const char *name;
    const char *type;          // in words, such as "number" or ":butt, :round or :square"
    const char *default_value; // in words; "": none
    const char *help;          // "": the name is self-explanatory
    const char *unit;          // in words, such as "turns"; "": none
} PetriNodeAttribute;

// Gets a kind of node by number. Returns false past the last.
PETRI_API bool petri_node_kind(size_t kind, PetriNodeKind *out, size_t size);

// Gets an attribute of a kind of node by number. Returns false past the last.
PETRI_API bool petri_node_attribute(size_t kind, size_t attribute, PetriNodeAttribute *out, size_t size);

// Parses a number with an optional suffix, as in scripts and options, or a time code, which is converted to seconds.
// Returns false if the text is not a number.
PETRI_API bool petri_parse_number(const char *text, double *x);

// A configuration of a session: script, definitions, statements of the prompt, fps, tempo and resolution.
// Configurations are shared, not copied, so a history of configurations takes little memory.
typedef struct PetriConfig PetriConfig;

// Returns the current configuration, or NULL if out of memory. Free it with petri_config_free before the session is
// closed.
PETRI_API PetriConfig *petri_config_get(PetriSession *session);

// Frees a configuration. NULL is ignored.
PETRI_API void petri_config_free(PetriConfig *config);

// Restores a configuration of the same session. State, frame number, time and beat continue.
PETRI_API void petri_config_apply(PetriSession *session, PetriConfig *config);

// Returns a number that changes whenever the configuration changes, including when an imported module changes on disk.
PETRI_API uint64_t petri_config_revision(const PetriSession *session);

// The prompt evaluates text that a user types, using the state after the last frame. Names of the script's top level
// have the values of the last frame, before its systems were advanced. If the configuration has changed since then, the
// script is evaluated again for that frame. It then uses the state before the frame, if petri_step computed the frame
// in this session and PetriOptions.rollback_frames is set, else the state after it. Before the first frame, the script
// is evaluated for frame 0.
//
// Result of petri_prompt_check: whether the input needs more lines.
typedef enum PetriCompleteness {
    PETRI_COMPLETE,    // complete, or invalid whatever follows
    PETRI_EXTENDABLE,  // complete, but may continue with indented lines
    PETRI_NEEDS_BLOCK, // must continue with indented lines
    PETRI_INCOMPLETE,  // must continue, for example in an open bracket
} PetriCompleteness;

// Returns whether input for petri_prompt is complete. If out of memory, reports a diagnostic and returns
// PETRI_COMPLETE.
PETRI_API PetriCompleteness petri_prompt_check(PetriSession *session, const char *text, size_t length);

// The numbers of statements of each kind that petri_prompt executed.
typedef struct PetriPromptResult {
    uint32_t values;   // expressions: evaluated once and written
    uint32_t bindings; // `let`, `func` and `import`: retained and evaluated in each frame, after the script
    // Nodes, also in `if` or `for`: written, retained, evaluated in each frame and added to the nodes of the script.
    uint32_t nodes;
    // A name that these statements bind, although the script also binds it at its top level; NULL: none. The script
    // keeps using its own binding. Valid as long as the session.
    const char *shadowed;
} PetriPromptResult;

// Executes statements. Writes values in printed form, nodes as trees and debug() output as `> text`; `write` may be
// NULL. Returns PETRI_INVALID if the text is not valid. A statement that fails is not retained and stops the execution.
PETRI_API PetriStatus petri_prompt(PetriSession *session, const char *text, size_t length, PetriWriteCallback *write,
                                   void *user_data, PetriPromptResult *result, size_t size);

// Removes the retained nodes of the prompt and, if `bindings` is true, also the bindings. Returns the number of removed
// statements; 0 if out of memory.
PETRI_API uint32_t petri_prompt_clear(PetriSession *session, bool bindings);

// Returns the text of a retained statement by number, or NULL past the last. Valid until the configuration changes.
PETRI_API const char *petri_prompt_statement(const PetriSession *session, size_t number);

// Result of petri_evaluate.
typedef struct PetriEvaluation {
    bool is_true;
    uint32_t length; // number of elements of the value
    double number;   // the value, if it is a single number, else NaN
    double seconds;  // duration of the evaluation, without compilation
} PetriEvaluation;

// Evaluates one expression like petri_prompt, without retaining it. Writes its value on one line, without a newline;
// `write` may be NULL. Returns PETRI_INVALID if the text is not a single valid expression.
PETRI_API PetriStatus petri_evaluate(PetriSession *session, const char *text, size_t length, PetriEvaluation *result,
                                     size_t size, PetriWriteCallback *write, void *user_data);

// Evaluates the script again for the last frame, or for frame 0 if there is no frame yet. Does nothing if that frame
// was already evaluated with the current configuration. petri_tree and petri_print then show the result. Returns
// PETRI_INVALID if no script is loaded.
PETRI_API PetriStatus petri_preview(PetriSession *session);

// Returns, by number, a name that statements of the prompt can use, or NULL past the last. Built-in functions are not
// included. The same name can occur twice. Valid as long as the session.
PETRI_API const char *petri_visible_name(const PetriSession *session, size_t number);

// Contents that petri_dump writes.
typedef enum PetriDump { PETRI_DUMP_AST, PETRI_DUMP_CODE } PetriDump;

// Writes the syntax tree or the compiled code of the loaded script. Returns PETRI_INVALID if no script is loaded, or if
// `write` returned false.
PETRI_API PetriStatus petri_dump(PetriSession *session, PetriDump what, PetriWriteCallback *write, void *user_data);

// Writes a table of the time spent since the script was loaded, longest first. There is a row for each source line that
// was evaluated, one for the particle systems, and one for `output_seconds`, the time that the host spent on output.
// Returns PETRI_INVALID if PetriOptions.profile is false, or if `write` returned false.
PETRI_API PetriStatus petri_profile(PetriSession *session, double output_seconds, PetriWriteCallback *write,
                                    void *user_data);

#ifdef __cplusplus
}
#endif

#endif
