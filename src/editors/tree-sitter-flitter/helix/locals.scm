; Scopes, definitions and references for Helix.
[(program) (suite) (function) (for) (where)] @local.scope
(names (name) @local.definition.variable)
(function name: (name) @local.definition.function)
(parameter name: (name) @local.definition.variable.parameter)
(variable) @local.reference
