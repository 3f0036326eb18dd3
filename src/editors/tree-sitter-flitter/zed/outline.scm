; The outline in Zed: functions and names.
(function "func" @context name: (name) @name) @item
(program (let "let" @context (binding names: (names . (name) @name)) @item))
