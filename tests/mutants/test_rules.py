#!/usr/bin/env python3
"""Which expressions scripts/mutants.py replaces, and which it refuses."""

import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))
sys.dont_write_bytecode = True
import mutants  # noqa: E402


def error(text, replacement="x"):
    """Of an expression between two @."""
    begin = text.index("@")
    end = text.index("@", begin + 1) - 1
    return mutants.parse_error(text.replace("@", ""), begin, end, replacement)


class Rules(unittest.TestCase):
    def test_whole_operands_are_replaced(self):
        for text in ("return @a + b@;", "a * @(b + c)@ / d;", "@a * b@ + c;", "a + @b * c@ - d;", "f(@1 - p@, q);",
                     "x = @-y@;", "a - @b@;", "v[@i - 1@]", "p ? @a : b@;", "if (@a <= b@ || c)", "@a < b@ ? c : d",
                     "sum += @w * f<double>(x)@;", "return @\"a, b\"@;", "f({@a ? b : c@, d});"):
            self.assertEqual(error(text), "", text)

    def test_parts_of_operands_are_refused(self):
        for text in ("a * @b + c@;", "@a + b@ * c;", "a - @b + c@;", "a / @b * c@;", "-@a + b@;", "@a ? b : c@ ? d : e",
                     "a @+ b@;", "@a + b@.c;", "a.@b@;", "x && @a || b@;", "@a + b@(c);", "!@a == b@;", "a @b@;"):
            self.assertNotEqual(error(text), "", text)

    def test_texts_comments_and_open_brackets_are_refused(self):
        for text in ("// of @n - 1@", 'f("a @b@ c");', "f(@(a + b@);", "@a; b@"):
            self.assertNotEqual(error(text), "", text)
        self.assertNotEqual(error("@a@;", "(b"), "")
        self.assertNotEqual(error("@a@;", ""), "")

    def test_all_mutants_of_a_file_are_in_its_copy(self):
        def mutant(number, begin, end, text, replacement):
            return mutants.Mutant(number, "", "", text, replacement, "", "", [], ("", ""), 1, begin, end)

        made = mutants.mutated("a + b;\n", [mutant(7, 0, 1, "@a@", "c"), mutant(8, 4, 5, "@b@", "d")])
        self.assertEqual(made, mutants.HEADER + "(::stylobate::mutant(7) ? (c) : (a)) + "
                                                "(::stylobate::mutant(8) ? (d) : (b));\n")

    def test_lists_are_those_of_the_sources(self):
        mutants.locate(mutants.read_lists())


if __name__ == "__main__":
    unittest.main()
