"""The texts of all errors that the sources throw, as patterns of what a page says of them."""

import re

TOKENS = re.compile(r"""
    //[^\n]* | /\*.*?\*/                       # comments
    | R"\((?P<raw>.*?)\)"
    | "(?P<text>(?:\\.|[^"\\])*)"
    | '(?:\\.|[^'\\])*'                        # a character
    | [A-Za-z_]\w* | \d[\w.']* | :: | << | [-+=!<>&|]= | \S
""", re.VERBOSE | re.DOTALL)
ERRORS = {"Error", "InputError", "IoError", "ResourceError", "MemoryError", "DeviceError"}
# They throw what they are given, which may get words around it where they are defined: there it has one of these names.
HELPERS = {"fail", "refuse", "damaged", "throwIoError"}
HANDED_ON = {"problem", "what", "why", "allowed"}
# Functions that return the whole text of an error, and those that return a part of one.
RETURNS_TEXT = {"failureOf", "weightsProblem"}
RETURNS_PART = {"didYouMean", "notMade", "ordinal", "counts", "remains", "row", "percentOfSide"}
# Stand for a value, and for what a helper was given.
VALUE, SLOT = "\x01", "\x02"


class Text(str):
    """A string literal."""


def is_text(piece):
    return isinstance(piece, Text)


def tokens_of(code):
    """Names, signs and literals, each with where it begins."""
    tokens = []
    for match in TOKENS.finditer(code):
        piece = match.group()
        if piece.startswith(("//", "/*")):
            continue
        text = match["text"] if match["text"] is not None else match["raw"]
        if text is not None:
            piece = Text(re.sub(r"\\(.)", lambda escaped: {"n": " "}.get(escaped[1], escaped[1]), text))
        tokens.append((piece, match.start()))
    return tokens


def closing(tokens, begin):
    """Where the bracket at `begin` is closed."""
    depth = 0
    for i in range(begin, len(tokens)):
        if is_text(tokens[i][0]):
            continue
        depth += (tokens[i][0] in ("(", "[", "{")) - (tokens[i][0] in (")", "]", "}"))
        if depth == 0:
            return i
    return len(tokens) - 1


def split(tokens, signs):
    """The parts between those of `signs` that are outside of brackets, up to the end of what they are in."""
    parts, i = [[]], 0
    while i < len(tokens):
        piece = tokens[i][0]
        opens = not is_text(piece) and piece in ("(", "[", "{")
        end = (closing(tokens, i) if opens else i) + 1
        if not is_text(piece) and piece in signs:
            parts.append([])
        else:
            parts[-1] += tokens[i:end]
        i = end
    return parts


class Source:
    """One file."""

    def __init__(self, name, code):
        self.name = name
        self.code = code
        self.tokens = tokens_of(code)
        self.helpers = list(self.bodies(HELPERS))

    def pattern(self, tokens, outer=True):
        """What an expression makes: words as in regular expressions, VALUE, SLOT, and for a choice a group.

        `outer`: not within a function, where a name in HANDED_ON may be anything."""
        choice = split(tokens, {"?"})
        if len(choice) > 1:
            rest = tokens[len(choice[0]) + 1:]
            first = split(rest, {":"})[0]
            return f"(?:{self.pattern(first)}|{self.pattern(rest[len(first) + 1:])})"
        operands = split(tokens, {"+", "<<", ","})
        if len(operands) > 1:
            return "".join(self.pattern(operand, outer) for operand in operands)
        pieces = [piece for piece, _ in tokens]
        if pieces and all(map(is_text, pieces)):
            return re.escape("".join(pieces))
        if pieces and pieces[-1] == ")" and not is_text(pieces[-1]):
            for before in ([], ["std", "::", "string"]):
                begin = len(before)
                if pieces[:begin] == before and pieces[begin] == "(" and closing(tokens, begin) == len(tokens) - 1:
                    return self.pattern(tokens[begin + 1:-1], not before and outer)
        if len(pieces) == 1:
            found = self.put_into(pieces[0], tokens[0][1])
            if found is not None:
                return found
            return SLOT if outer and pieces[0] in HANDED_ON and self.is_in_helper(tokens[0][1]) else VALUE
        if pieces[1:] == [".", "str", "(", ")"]:
            return self.put_into(pieces[0], tokens[0][1]) or VALUE
        # A function of words, as counted(rows, "row").
        words = [re.escape(piece) for piece in pieces if is_text(piece) and re.search("[a-z]{2}", piece)]
        return VALUE + "".join(word + VALUE for word in words)

    def message(self, arguments):
        """The pattern of an error's text: it has a subject, if two arguments are given."""
        subject, *problem = split(arguments, {","})
        if not problem:
            return self.pattern(subject)
        return self.pattern(subject, False) + re.escape(": ") + self.pattern(arguments[len(subject) + 1:])

    def put_into(self, name, before):
        """What was put into the local string or stream `name` since it was declared."""
        end = next((i for i, (_, at) in enumerate(self.tokens) if at >= before), len(self.tokens))
        for begin in range(end - 1, max(end - 300, 0), -1):
            if self.tokens[begin][0] == name and self.tokens[begin - 1][0] in ("ostringstream", "string", "*") \
                    and self.tokens[begin + 1][0] in (";", "="):
                break
        else:
            return None
        if any(self.tokens[i][0] == name and self.tokens[i + 1][0] == "+=" for i in range(begin, end)):
            return VALUE # a list
        found = ""
        for i in range(begin, end):
            if self.tokens[i][0] == name and self.tokens[i + 1][0] in ("<<", "="):
                found += self.pattern(split(self.tokens[i + 2:i + 200], {";"})[0])
        return found or None

    def line(self, at):
        return self.code.count("\n", 0, at) + 1

    def calls(self, names):
        """Each call of one of these functions, or value of one of these types: what is in its brackets, and where."""
        for i, (piece, at) in enumerate(self.tokens[:-1]):
            if is_text(piece) or piece not in names or self.tokens[i - 1][0] in ("class", "~", "explicit", "struct"):
                continue
            begin = i + 1
            if piece in ERRORS and re.fullmatch(r"[A-Za-z]\w*", self.tokens[begin][0]):
                begin += 1 # a value that is thrown later has a name
            if self.tokens[begin][0] == "(" and not is_text(self.tokens[begin][0]):
                yield self.tokens[begin + 1:closing(self.tokens, begin)], at

    def bodies(self, names):
        """The bodies of functions of these names, also of local ones."""
        for i, (piece, _) in enumerate(self.tokens[:-1]):
            if is_text(piece) or piece not in names or self.tokens[i + 1][0] not in ("(", "="):
                continue
            begin = next((j for j in range(i, min(i + 60, len(self.tokens)))
                          if not is_text(self.tokens[j][0]) and self.tokens[j][0] in ("{", ";")), None)
            if begin is not None and self.tokens[begin][0] == "{":
                yield self.tokens[begin:closing(self.tokens, begin)]

    def is_in_helper(self, at):
        return any(body[0][1] <= at <= body[-1][1] for body in self.helpers)

    def returned(self, names):
        """What is returned by functions of these names."""
        for body in self.bodies(names):
            for i, (word, at) in enumerate(body):
                if word == "return" and not is_text(word):
                    said = split(body[i + 1:], {";"})[0]
                    if said:
                        yield said[1:-1] if said[0][0] == "{" else said, at


class Thrown:
    """A text that is thrown at a place."""

    def __init__(self, where, text):
        self.where = where
        self.text = re.sub(VALUE + "+", VALUE, text)

    def words(self):
        """For people: values are dots."""
        return re.sub(r"\\(.)", r"\1", self.text.replace(VALUE, "…").replace(SLOT, "…"))


def has_words(text):
    return re.search("[a-z]{2}", text) is not None


def longest_words(text):
    """Those that a text has whatever its values are."""
    plain = re.sub(r"\(\?:.*\)|" + f"[{VALUE}{SLOT}]", "\n", text)
    return max(re.sub(r"\\(.)", r"\1", plain).split("\n"), key=len)


class Sources:
    """`thrown`: all texts; `wrappers`: those around what a caller gives; `parts`: what may stand for a value;
    `wordless`: the files that throw values only."""

    def __init__(self, root, folders):
        self.thrown, self.wrappers, self.parts, self.wordless = [], [], [], set()
        for folder in folders:
            for path in sorted((root / folder).rglob("*")):
                if path.suffix in (".cpp", ".h"):
                    self.add(Source(str(path.relative_to(root)), path.read_text()))

    def add(self, source):
        parts = [source.pattern(said) for said, _ in source.returned(RETURNS_PART)]
        parts = [text for text in parts if has_words(text)]
        self.parts += parts
        errors = [(source.message(said), at) for said, at in source.calls(ERRORS)]
        for text, _ in errors:
            if SLOT not in text and not has_words(text):
                self.wordless.add(source.name)
        others = [*source.calls(HELPERS), *source.returned(RETURNS_TEXT)]
        for text, at in errors + [(source.pattern(said), at) for said, at in others]:
            if SLOT in text:
                self.wrappers.append(Thrown(f"{source.name}:{source.line(at)}", text))
            elif has_words(text) and text not in parts:
                self.thrown.append(Thrown(f"{source.name}:{source.line(at)}", text))

    def tells(self, message, thrown):
        """Whether a message of a page is that of `thrown`: there, names in capitals stand for values."""
        plain = r"[^a-z]*"
        # Values are also an s, where there are several of a thing, and parts that functions return.
        parts = "|".join(part.replace(VALUE, plain) for part in self.parts)
        text = re.sub(r"^(model|cage|posed\\ cage|points):", r"(?:\1|FILE):", thrown.text) # the command names the file
        inner = plain + text.replace(VALUE, rf"{plain}(?:(?:s|{parts}){plain})?") + plain
        if longest_words(text) not in message: # soon told: expressions take long
            return False
        around = [wrapper.text.replace(VALUE, plain).split(SLOT) for wrapper in self.wrappers
                  if has_words(wrapper.text) and longest_words(wrapper.text) in message]
        return any(re.fullmatch(plain + before + inner + after + plain, message)
                   for before, after in [["", ""], *around])
