"""Finds the places of C, bison and re2c sources where a small fault can be planted.

Relies on the layout of clang-format: binary operators have spaces on both sides, and names of functions touch their
parentheses. Only bodies of functions and actions of grammars get faults; preprocessor lines, assertions, comments and
strings do not.
"""
import re
from collections import namedtuple

# Replace text[start:end] with `new`; `line` counts from 1.
Fault = namedtuple('Fault', 'start end new line kind')
Token = namedtuple('Token', 'text start end spaced')  # spaced: white space on both sides

TOKEN = re.compile(r'''
    (?P<skip>\s+|//[^\n]*|/\*.*?\*/|^[ \t]*\#(?:[^\n\\]|\\.)*)
  | (?P<token>"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)*'|(?:0[xX]|\.?\d)(?:[eEpP][+-]|[\w.])*|[A-Za-z_$][\w$]*
     |<<=|>>=|->|\+\+|--|<<|>>|[-+*/%&|^=!<>]=|&&|\|\||[^\s])
''', re.X | re.S | re.M)

OPERATORS = {'<': '<=', '<=': '<', '>': '>=', '>=': '>', '==': '!=', '!=': '==', '&&': '||', '||': '&&', '+': '-',
             '-': '+', '*': '/', '/': '*', '%': '*', '&': '|', '|': '&', '^': '&', '<<': '>>', '>>': '<<'}
ASSIGNMENTS = {'+=': '-=', '-=': '+=', '*=': '/=', '/=': '*=', '|=': '&=', '&=': '|=', '^=': '&=', '<<=': '>>=',
               '>>=': '<<=', '++': '--', '--': '++'}
NAMES = {'true': 'false', 'false': 'true'}
KEYWORDS = set('if for while do switch case default return sizeof goto else typedef static const struct union enum extern'
               ' inline register volatile break continue _Alignof _Generic'.split())
ASSERTIONS = {'assert', 'static_assert', '_Static_assert'}
OPENING, CLOSING = {'(': ')', '[': ']', '{': '}'}, set(')]}')


def tokens_of(text):
    """Returns the tokens of a source without comments and preprocessor lines."""
    found, at = [], 0
    while at < len(text):
        match = TOKEN.match(text, at)
        start, at = at, match.end()
        if match.group('token'):
            spaced = text[start - 1:start].isspace() and text[at:at + 1].isspace()
            found.append(Token(match.group('token'), start, at, spaced))
    return found


def match_brackets(tokens):
    """Returns for each opening bracket the index of the closing one, and the set of tokens directly within braces."""
    partners, stack, within_braces = {}, [], set()
    for i, token in enumerate(tokens):
        if token.text in CLOSING and stack:
            partners[stack.pop()] = i
        if stack and tokens[stack[-1]].text == '{':
            within_braces.add(i)
        if token.text in OPENING:
            stack.append(i)
    return partners, within_braces


def bodies_of(tokens, partners, grammar):
    """Yields the ranges of tokens that are bodies of functions or actions of a grammar."""
    i, rules = 0, not grammar
    while i < len(tokens):
        text, before = tokens[i].text, tokens[i - 1].text if i else ''
        if text == '{' and i in partners:
            if before == ')' or (grammar and rules and before != '='):
                yield i + 1, partners[i]
            # A `%code {` section of bison contains functions.
            i = i + 1 if grammar and before == 'code' else partners[i] + 1
            continue
        if text == '%' and i + 1 < len(tokens) and tokens[i + 1].text == '%' or text == '*' and before == '%':
            rules = True
        i += 1


def number_fault(text):
    """Returns another number than the literal `text`."""
    if re.fullmatch(r'0[uUlL]*', text):
        return '1' + text[1:]
    if re.fullmatch(r'1[uUlL]*', text):
        return '0' + text[1:]
    return f'({text} + 1)'


def statement_end(tokens, partners, start, stop):
    """Returns the index of the semicolon that ends the statement at `start`; None if there is none."""
    i = start
    while i < stop:
        if tokens[i].text == ';':
            return i
        if tokens[i].text == '{' and tokens[i - 1].text not in ('=', ')', ','):
            return None
        i = partners.get(i, i) + 1
    return None


def is_expression(tokens, partners, i, end):
    """Returns whether the statement is a call, an assignment, an increment or a jump without a value."""
    if tokens[i].text in ('break', 'continue', 'return'):
        return i + 1 == end
    while i < end and tokens[i].text in ('*', '++', '--'):
        i += 1
    if tokens[i].text == '(':
        i = partners[i] + 1
    elif not re.match(r'[A-Za-z_$]', tokens[i].text) or tokens[i].text in KEYWORDS:
        return False
    else:
        i += 1
    while i < end and tokens[i].text in ('.', '->', '['):
        i = partners[i] + 1 if tokens[i].text == '[' else i + 2
    return i == end or tokens[i].text in ('=', '(', '++', '--') or tokens[i].text in ASSIGNMENTS


def arguments_of(tokens, partners, opening):
    """Returns the ranges of tokens of a call's arguments."""
    found, start, i, end = [], opening + 1, opening + 1, partners[opening]
    while i < end:
        if tokens[i].text == ',':
            found.append((start, i))
            start = i + 1
        i = partners.get(i, i) + 1
    return found + [(start, end)] if start < end else found


class Finder:
    """Collects the faults of one source."""

    def __init__(self, text):
        self.text = text
        self.tokens = tokens_of(text)
        self.partners, self.within_braces = match_brackets(self.tokens)
        self.faults = []

    def add(self, start, end, new, kind):
        """Adds a fault that replaces the characters from `start` to `end`."""
        self.faults.append(Fault(start, end, new, self.text.count('\n', 0, start) + 1, kind))

    def source(self, first, stop):
        """Returns the source of a range of tokens."""
        return self.text[self.tokens[first].start:self.tokens[stop - 1].end]

    def add_condition(self, opening):
        """Negates the condition of `if` and `while`."""
        start, end = self.tokens[opening].end, self.tokens[self.partners[opening]].start
        self.add(start, end, f'!({self.text[start:end]})', 'condition')

    def add_swaps(self, opening):
        """Swaps neighbouring arguments of a call."""
        arguments = arguments_of(self.tokens, self.partners, opening)
        for (first, stop), (first2, stop2) in zip(arguments, arguments[1:]):
            one, two = self.source(first, stop), self.source(first2, stop2)
            if one != two:
                between = self.text[self.tokens[stop - 1].end:self.tokens[first2].start]
                self.add(self.tokens[first].start, self.tokens[stop2 - 1].end, two + between + one, 'arguments')

    def add_token(self, i):
        """Adds the faults of operators and constants at token i."""
        token, before = self.tokens[i], self.tokens[i - 1].text
        text = token.text
        if text in OPERATORS and token.spaced or text in ASSIGNMENTS:
            self.add(token.start, token.end, OPERATORS.get(text) or ASSIGNMENTS[text], 'operator')
        elif text == '!' or (text == '-' and not token.spaced):
            self.add(token.start, token.end, '', 'operator')
        elif text in NAMES:
            self.add(token.start, token.end, NAMES[text], 'constant')
        elif re.match(r'\.?\d', text):
            self.add(token.start, token.end, number_fault(text), 'constant')
        elif text[0] == "'" and before != 'case':
            self.add(token.start, token.end, f'({text} + 1)', 'constant')

    def add_body(self, start, stop):
        """Adds the faults of the tokens from `start` to `stop`."""
        i = start
        while i < stop:
            token, before = self.tokens[i], self.tokens[i - 1].text
            following = self.tokens[i + 1].text if i + 1 < stop else ''
            if token.text in ASSERTIONS and following == '(':
                i = self.partners[i + 1] + 1
                continue
            if i in self.within_braces and before in (';', '{', '}', ')', 'else', ':'):
                end = statement_end(self.tokens, self.partners, i, stop)
                # Deleting a jump at the end of a case falls into the next one; that is a fault as well.
                if end is not None and is_expression(self.tokens, self.partners, i, end):
                    self.add(token.start, self.tokens[end].start, '', 'statement')
            if following == '(':
                if token.text in ('if', 'while'):
                    self.add_condition(i + 1)
                elif re.match(r'[A-Za-z_]', token.text) and token.text not in KEYWORDS and not self.tokens[i + 1].spaced:
                    self.add_swaps(i + 1)
            self.add_token(i)
            i += 1


def faults_of(text, grammar=False):
    """Returns the faults that can be planted in a source, in the order of the text; `grammar`: of bison or re2c."""
    finder = Finder(text)
    for start, stop in bodies_of(finder.tokens, finder.partners, grammar):
        finder.add_body(start, stop)
    return sorted(finder.faults)


def plant(text, fault):
    """Returns the source with the fault."""
    return text[:fault.start] + fault.new + text[fault.end:]
