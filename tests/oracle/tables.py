"""Tables as headers of core/physics have them."""


def table(kind, name, numbers):
    lines, line = [], "   "
    for number in numbers:
        if len(line) + len(str(number)) + 2 > 79:
            lines.append(line)
            line = "   "
        line += f" {number},"
    return (f"HD_TABLE({kind}, {name}, {len(numbers)}) = {{\n"
            + "\n".join(lines + [line]) + "\n};\n")
