"""What stands in for an operator, a literal or a vector function."""
import re

RELATIONS = {"<": ("<=", ">="), "<=": ("<", ">"), ">": (">=", "<="), ">=": (">", "<"),
             "==": ("!=",), "!=": ("==",)}
LOGIC = {"&&": ("||",), "||": ("&&",)}
ARITHMETIC = {"+": ("-",), "-": ("+",), "*": ("/",), "/": ("*",), "%": ("*",)}
ASSIGNMENTS = {sign + "=": tuple(other + "=" for other in others)
               for sign, others in ARITHMETIC.items()}

# Functions of Highway, which the sources call hn, by others with the same arguments and result.
VECTOR_FUNCTIONS = {
    "Add": ("Sub",), "Sub": ("Add",), "Mul": ("Add",), "Div": ("Mul",),
    "MulAdd": ("MulSub",), "MulSub": ("MulAdd",), "NegMulAdd": ("MulAdd",),
    "Lt": ("Le", "Ge"), "Le": ("Lt", "Gt"), "Gt": ("Ge", "Le"), "Ge": ("Gt", "Lt"),
    "Eq": ("Ne",), "Ne": ("Eq",), "And": ("Or",), "Or": ("And",), "Min": ("Max",), "Max": ("Min",),
    "InterleaveLower": ("InterleaveUpper",), "InterleaveUpper": ("InterleaveLower",),
}
# Those of which the last argument alone will do.
VECTOR_IDENTITIES = {"Abs", "Neg", "IfThenElseZero"}
VECTOR_CALL = re.compile(r"hn::(\w+)\s*\(")

INTEGER = re.compile(r"(0[xX][0-9a-fA-F]+|\d+)[uUlL]*$")
FLOATING = re.compile(r"(?:\d+\.\d*|\.\d+|\d+(?=[eE]))(?:[eE][-+]?\d+)?[fFlL]?$")


def literal_variants(text, floating):
    """Returns texts of 0, the double and the half of a number; of 1 for a zero.

    `floating` says that the number, integer or not, is turned into a floating one.
    """
    integer = INTEGER.match(text)
    if integer:
        value = int(integer.group(1), 0)
    elif FLOATING.match(text):
        value = float(text.rstrip("fFlL"))
        floating = True
    else:
        return []
    if value == 0:
        return [text + " + 1"]
    half = value / 2 if floating else value // 2
    two = "2" if integer and not floating else "2.0F" if text[-1] in "fF" else "2.0"
    variants = {0: text + " * 0", 2 * value: text + " * 2"}
    variants.setdefault(half, text + " / " + two)
    return list(variants.values())
