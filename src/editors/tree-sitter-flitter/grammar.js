// grammar.js: the grammar of Flitter for tree-sitter, with the rules of grammar/parser.y. src/scanner.c handles lines,
// indentation and parentheses. No word is reserved: a word is a keyword only where the grammar accepts the keyword.

const list = (separator, rule) => seq(rule, repeat(seq(separator, rule)));

module.exports = grammar({
    name: "flitter",
    word: ($) => $.name,
    externals: ($) => [$._newline, $._indent, $._dedent, $.comment, $._blank, "(", ")"],
    extras: ($) => [/[ \t\r]/, /\\\r?\n/, $.comment, $._blank],

    rules: {
        program: ($) => seq(optional($.shebang), $._newline, repeat($.pragma), repeat($._item)),
        shebang: () => token(prec(1, /#![^\n]*\n/)),
        pragma: ($) => seq("%pragma", field("name", $.name), field("value", $._literal), $._newline),

        _item: ($) => choice($._statement, $.let, $.let_stable, alias($.function_statement, $.function), $.import),
        suite: ($) => seq($._newline, $._indent, repeat($._item), $._dedent),
        // The suite of an `if` has a separate rule, because `else` is a keyword only after such a suite.
        _if_suite: ($) => seq($._newline, $._indent, repeat($._item), $._dedent),

        let: ($) => seq("let", choice($._lets, alias($._let_suite, $.binding))),
        let_stable: ($) => seq("let", "stable", $._lets),
        _let_suite: ($) => seq(field("names", $.names), "=", field("value", $.suite)),
        _lets: ($) =>
            seq(repeat1($.binding), $._newline, optional(seq($._indent, repeat1(seq(repeat1($.binding), $._newline)), $._dedent))),
        binding: ($) => seq(field("names", $.names), "=", field("value", $._composed)),
        names: ($) => list(";", $.name),

        function_statement: ($) => seq("func", optional(field("name", $.name)), $.parameters, field("body", $.suite)),
        parameters: ($) => seq("(", optional(list(",", $.parameter)), ")"),
        parameter: ($) => seq(field("name", $.name), optional(seq("=", field("default", $._decorated)))),
        import: ($) => seq("import", $.names, "from", field("file", $._composed), $._newline),

        _statement: ($) =>
            choice(
                seq($._decorated, $._newline),
                $.append,
                $.template,
                $.for,
                $.if,
                $.include,
            ),
        append: ($) =>
            choice(
                seq(field("parent", $._decorated), field("children", $.suite)),
                seq(field("parent", $._decorated), "<<", optional($._newline), field("children", $._statement)),
            ),
        template: ($) => seq("@", field("function", $._atom), repeat($.attribute), choice($._newline, $.suite)),
        include: ($) => seq("%include", field("file", $._composed), $._newline),
        for: ($) => seq("for", list(",", $.clause), field("body", $.suite)),
        clause: ($) => seq($.names, "in", field("source", $._composed)),
        if: ($) =>
            seq("if", field("test", $._composed), alias($._if_suite, $.suite), repeat($.elif), optional($.else)),
        elif: ($) => seq("elif", field("test", $._composed), alias($._if_suite, $.suite)),
        else: ($) => seq("else", $.suite),

        _chain: ($) => choice($._decorated, alias($.chained, $.append)),
        chained: ($) => seq(field("parent", $._decorated), "<<", field("children", $._chain)),
        _decorated: ($) => choice($._composed, $.decorated),
        decorated: ($) => seq($._composed, repeat1(choice($.tag, $.attribute))),
        attribute: ($) => seq(field("name", $.name), "=", field("value", $._composed)),

        _composed: ($) => choice($._lambda, $.composed),
        composed: ($) => seq($._lambda, repeat1(seq(";", $._lambda))),
        _lambda: ($) => choice(alias($.lambda, $.function), $._looped),
        lambda: ($) => seq("func", $.parameters, field("body", $._lambda)),
        _looped: ($) => choice($._conditional, alias($.looped, $.for), $.where),
        looped: ($) => seq(field("body", $._looped), "for", $.names, "in", field("source", $._conditional)),
        // A name after the bindings begins a further binding.
        where: ($) => prec.right(seq($._looped, "where", repeat1(alias($.where_binding, $.binding)))),
        where_binding: ($) => seq(field("names", $.names), "=", field("value", $._conditional)),
        _conditional: ($) => choice($._or, $.conditional),
        conditional: ($) =>
            seq(field("then", $._or), "if", field("test", $._or), optional(seq("else", field("else", $._conditional)))),

        _or: ($) => choice($._and, alias($.or, $.binary)),
        or: ($) => seq(field("left", $._or), field("operator", choice("or", "xor")), field("right", $._and)),
        _and: ($) => choice($._not, alias($.and, $.binary)),
        and: ($) => seq(field("left", $._and), field("operator", "and"), field("right", $._not)),
        _not: ($) => choice($._compared, alias($.not, $.unary)),
        not: ($) => seq(field("operator", "not"), $._not),
        _compared: ($) => choice($._ranged, alias($.compared, $.binary)),
        compared: ($) =>
            seq(
                field("left", $._ranged),
                field("operator", choice("==", "!=", "<", ">", "<=", ">=", "in")),
                field("right", $._ranged),
            ),
        _ranged: ($) => choice($._sum, $.range),
        range: ($) =>
            seq(optional(field("start", $._sum)), "..", field("stop", $._sum), optional(seq("|", field("step", $._sum)))),
        _sum: ($) => choice($._product, alias($.sum, $.binary)),
        sum: ($) => seq(field("left", $._sum), field("operator", choice("+", "-")), field("right", $._product)),
        _product: ($) => choice($._signed, alias($.product, $.binary)),
        product: ($) =>
            seq(field("left", $._product), field("operator", choice("*", "/", "//", "%")), field("right", $._signed)),
        _signed: ($) => choice($._power, alias($.signed, $.unary)),
        signed: ($) => seq(field("operator", choice("-", "+")), $._signed),
        _power: ($) => choice($._postfix, alias($.power, $.binary)),
        power: ($) => seq(field("left", $._power), field("operator", "**"), field("right", $._postfix)),

        _postfix: ($) => choice($._atom, $.call, $.index),
        call: ($) => seq(field("function", $._postfix), $.arguments),
        arguments: ($) =>
            seq(
                "(",
                optional(
                    choice(
                        seq(list(",", $._chain), repeat(seq(",", $.argument))),
                        list(",", $.argument),
                    ),
                ),
                ")",
            ),
        argument: ($) => seq(field("name", $.name), "=", field("value", $._chain)),
        index: ($) => seq(field("vector", $._postfix), "[", field("index", $._chain), "]"),

        _atom: ($) => choice($._literal, alias($.name, $.variable), $.lookup, $.parenthesised),
        lookup: ($) => seq("$", field("key", $._atom)),
        parenthesised: ($) => seq("(", $._chain, ")"),
        _literal: ($) => choice($.number, $.timecode, $.string, $.symbol, $.node),

        name: () => /[_\p{Alphabetic}][_\p{Alphabetic}\p{Nd}]*'*/,
        symbol: () => /:[_\p{Alphabetic}][_\p{Alphabetic}\p{Nd}]*'*/,
        node: () => /![_\p{Alphabetic}][_\p{Alphabetic}\p{Nd}]*'*/,
        tag: () => /#[_\p{Alphabetic}][_\p{Alphabetic}\p{Nd}]*'*/,
        number: () => /([0-9][_0-9]*(\.[0-9][_0-9]*)?|\.[0-9][_0-9]*)([eE][-+]?[0-9][_0-9]*)?([pnuµmkMGT°]|deg)?/,
        timecode: () => /([0-9]+:)?[0-5]?[0-9]:[0-5]?[0-9](\.[0-9]+)?/,
        string: () =>
            token(
                choice(
                    /'([^'\\\n]|\\[^\n])*'/,
                    /"([^"\\\n]|\\[^\n])*"/,
                    /'''('?'?([^'\\]|\\[^\n]))*'''/,
                    /"""("?"?([^"\\]|\\[^\n]))*"""/,
                ),
            ),
    },
});
