; Scopes, definitions and references. A binding holds for the rest of its suite.
[(program) (suite) (function) (for) (where)] @local.scope
(binding names: (names (name) @local.definition.var))
(clause (names (name) @local.definition.var))
(for (names (name) @local.definition.var))
(import (names (name) @local.definition.import))
(function name: (name) @local.definition.function)
(parameter name: (name) @local.definition.parameter)
(variable) @local.reference
