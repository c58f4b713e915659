# SPDX-License-Identifier: BSD-3-Clause
"""A C++ file as its declarations."""
import re


class Source:
    """A C++ file as its declarations: types and functions with their namespace and lines, and names in unnamed namespaces."""

    def __init__(self, path, text):
        self.path = path
        self.text = text
        self.lines = text.count("\n")
        self.types = []  # (namespace path, name, is in an unnamed namespace)
        self.functions = []  # (name, lines)
        self.unnamed = []  # (namespace path, kind, name, parameters)
        self.named = []  # the same of named namespaces
        self.constants = []  # names of const and constexpr variables of namespaces, and of static ones of classes
        _scan(without_comments(text), self)


def without_comments(text):
    """The text with comments, strings, characters and preprocessor lines emptied, line by line as long as before."""
    pattern = r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:[^"\\\n]|\\.)*"|(?<![0-9A-Fa-f])\'(?:[^\'\\\n]|\\.)*\'|^[ \t]*#(?:[^\n\\]|\\.|\\\n)*'

    def emptied(match):
        found = match.group(0)
        return ('""' if found[0] in '"R' else "0" if found[0] == "'" else "") + "\n" * found.count("\n")

    return re.sub(pattern, emptied, text, flags=re.S | re.M)


def _scan(code, source):
    """Walks along the braces of the code and notes what is declared outside of functions."""
    scopes = []  # (kind, name, line where it began)
    head, line, at = "", 1, 0
    depth_inside = 0  # braces within a function or an initialiser
    for match in re.finditer(r"[{};]|\n", code):
        token = match.group(0)
        if depth_inside == 0:
            head += code[at:match.start()] + ("\n" if token == "\n" else "")
        at = match.end()
        if token == "\n":
            line += 1
        elif depth_inside > 0:
            depth_inside += {"{": 1, "}": -1, ";": 0}[token]
            if depth_inside == 0 and scopes[-1][0] == "function":
                _, name, begin = scopes.pop()
                source.functions.append((name, line - begin + 1))
                head = ""
            elif depth_inside == 0:
                scopes.pop()
                head += "{}"
        elif token == "{":
            words = " ".join(head.split())
            kind, name = _opened(words, head)
            begin = line - head.lstrip().count("\n")
            if kind in ("function", "value"):
                if kind == "function":
                    _note(words + " {}", scopes, source)
                depth_inside = 1
            else:
                if kind == "type":
                    _note_type(name, scopes, source)
                head = ""
            scopes.append((kind, name, begin))
        elif token == "}":
            if scopes:
                scopes.pop()
            head = ""
        else:
            _note(" ".join(head.split()), scopes, source)
            head = ""


def _opened(words, head):
    """(kind, name) of what a brace opens after these words: namespace, type, function or value."""
    match = re.match(r"(?:inline )?namespace(?: ([\w:]+))?$", words)
    if match:
        return "namespace", match.group(1) or ""
    if words == 'extern ""':
        return "namespace", "C"
    plain = re.sub(r"^(?:(?:public|private|protected) ?: ?)+", "", words)
    plain = re.sub(r"^(?:template ?<(?:[^<>]|<[^<>]*>)*> ?)+", "", plain)
    match = re.match(r"(?:class|struct|union|enum(?: class| struct)?)\b(?: alignas ?\([^)]*\))? ?([\w:]*)", _without_arguments(plain))
    if match and "(" not in plain.replace("alignas(", "").split(":")[0] and "=" not in plain:
        return "type", match.group(1)
    if "(" in plain and not (head[-1:].strip() and head[-1] not in ")}") and not re.search(r"[=,({] ?$", plain):
        return "function", _function_name(plain)
    return "value", ""


def _without_arguments(words):
    """The words without arguments of templates."""
    while (plain := re.sub(r"<[^<>]*>", "", words)) != words:
        words = plain
    return words


def _function_name(words):
    match = re.search(r"([\w:~]+|operator ?[^\s(]+)(?:<[^<>()]*>)? ?\(", _without_arguments(words))
    return match.group(1) if match else "?"


def _spaces(scopes):
    """(path, is unnamed) of the namespaces around; None inside a type."""
    if any(kind != "namespace" for kind, _, _ in scopes):
        return None
    names = [name for _, name, _ in scopes]
    return "::".join(name for name in names if name), "" in names


def _note_type(name, scopes, source):
    if not name:
        return
    unnamed = any(kind == "namespace" and not scope for kind, scope, _ in scopes)
    path = "::".join(scope for _, scope, _ in scopes if scope)
    source.types.append((path, name, unnamed))
    spaces = _spaces(scopes)
    if spaces:
        (source.unnamed if spaces[1] else source.named).append((spaces[0], "type", name, ""))


def _note(words, scopes, source):
    """A function or a variable: of namespaces, with the constants of classes."""
    if scopes and scopes[-1][0] == "type":
        plain = re.sub(r"^(?:(?:public|private|protected) ?: ?)+", "", words)
        if re.match(r"(?:inline )?static (?:inline )?const\b", plain):
            source.constants += _constants(plain)
    spaces = _spaces(scopes)
    match = re.match(r"using (?:[\w]+::)+(\w+)$", words)
    if spaces and match:
        source.unnamed.append((spaces[0], "using" if spaces[1] else "outer using", match.group(1), words))
    match = re.match(r"using (\w+) = (.*)$", words)
    if spaces and match:
        (source.unnamed if spaces[1] else source.named).append((spaces[0], "alias", match.group(1), match.group(2)))
    if not spaces or re.match(r"(using|namespace|typedef|TEST|INSTANTIATE|TYPED|static_assert|friend|template class)\b|TEST_", words):
        return
    names = source.unnamed if spaces[1] else source.named
    plain = re.sub(r"^(?:template ?<(?:[^<>]|<[^<>]*>)*> ?)+", "", words)
    if re.match(r"(?:class|struct|enum)\b[^({=]*$", plain):
        return  # a declaration in advance
    shorter = re.sub(r"<[^<>=]*>", lambda found: "_" * len(found.group(0)), plain)
    bracket, equals = shorter.find("("), plain.find("=")
    if 0 <= bracket and (equals < 0 or bracket < equals) and not re.match(r"[^(]*\w ?\{", plain):
        name = _function_name(plain)
        is_constant = re.match(r"(?:(?:inline|static) )*const(?:expr)? [^(]*\( ?[-.\d\"]", plain)
        if is_constant:
            source.constants.append(name)
        if re.match(r"k[A-Z]", name) or is_constant:  # a constant with arguments
            names.append((spaces[0], "variable", name, ""))
        elif "::" not in name and (plain.endswith("{}") or not spaces[1]):
            names.append((spaces[0], "function", name, _parameters(plain[bracket + 1:])))
        return
    source.constants += _constants(plain)
    for declarator in split(plain):
        match = re.search(r"([\w:]+) ?(?:\[[^\]]*\] ?)*(?:\{.*)?$", declarator.split("=")[0].strip())
        if match and "::" not in match.group(1):
            names.append((spaces[0], "variable", match.group(1), ""))


def _constants(plain):
    """Names of variables that a declaration makes constant; names for the linker are not ours to choose."""
    match = re.match(r"(?:(?:inline|static|extern|thread_local|const|constexpr) )*", plain)
    if not re.search(r"\bconst", match.group(0)) or '""' in match.group(0) or plain.startswith('extern ""'):
        return
    bare = plain
    while (shorter := re.sub(r"<[^<>=]*>", "", bare)) != bare:
        bare = shorter
    for declarator in split(bare):
        declared = re.split(r"[={]", declarator)[0].strip()
        name = re.search(r"(\w+) ?(?:\[[^\]]*\] ?)*$", declared)
        star = declared.rfind("*")
        is_pointer = star >= 0 and "const" not in declared[star:] and "constexpr" not in match.group(0)
        if name and "(" not in declared and "::" + name.group(1) not in declared and not is_pointer:
            yield name.group(1)


def split(words):
    """The parts between commas outside of brackets, up to the bracket that closes what is around them."""
    depth, parts, part = 0, [], ""
    for c in words:
        if c in "(<[{":
            depth += 1
        elif c in ")>]}":
            depth -= 1
            if depth < 0:
                break
        if c == "," and depth == 0:
            parts.append(part)
            part = ""
        else:
            part += c
    return parts + [part]


def _parameters(words):
    """The types of parameters, from what stands after the opening bracket."""
    parts = split(words)
    return ", ".join(re.sub(r"(?<=[\w>&*\]]) ?\b\w+$", "", p.split("=")[0].strip()) if " " in p.strip() or "&" in p else p.strip() for p in parts)
