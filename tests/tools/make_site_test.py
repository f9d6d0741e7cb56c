"""Pages of the site have the links, comments and code that they should; the C++ reference shows what Doxygen read."""

import pathlib
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/site"))
sys.dont_write_bytecode = True
import cpp_reference  # noqa: E402
import make_site  # noqa: E402

STRUCT = """<doxygen><compounddef id="s" kind="struct"><compoundname>insonify::Box</compoundname><sectiondef>
<memberdef kind="variable" id="w" prot="public" static="no"><type>std::vector&lt; double &gt;</type><argsstring></argsstring><name>width</name>
<qualifiedname>insonify::Box::width</qualifiedname><initializer>= {1.5}</initializer><briefdescription/>
<detaileddescription><para>Across [m], of <ref refid="s">Box</ref>.</para></detaileddescription><location file="insonify/mesh.h" line="7"/></memberdef>
<memberdef kind="function" id="c" prot="public" static="no"><type/><argsstring>(const Box &amp;)=delete</argsstring><name>Box</name>
<qualifiedname>insonify::Box::Box</qualifiedname><location file="insonify/mesh.h" line="8"/></memberdef>
<memberdef kind="function" id="a" prot="public" static="no"><type>const double &amp;</type><argsstring>(int scale=2) const</argsstring><name>area</name>
<qualifiedname>insonify::Box::area</qualifiedname><briefdescription/><detaileddescription><para>Its area.</para></detaileddescription>
<location file="insonify/mesh.h" line="9"/></memberdef></sectiondef><briefdescription/>
<detaileddescription><para>A box.</para></detaileddescription><location file="insonify/mesh.h" line="5"/></compounddef></doxygen>"""


class MakeSiteTest(unittest.TestCase):
    @staticmethod
    def page(text):
        """A page of docs/how-to as the site has it."""
        return make_site.page(ROOT / "docs/how-to/page.md", text)

    def test_links_out_of_the_pages_lead_to_the_project_pages(self):
        self.assertEqual(self.page("[a](../../CHANGELOG.md#unreleased) [b](../faq.md) [c](https://a.example) [d](#x)\n"),
                         "[a](../project/changelog.md#unreleased) [b](../faq.md) [c](https://a.example) [d](#x)\n")

    def test_code_is_as_it_was(self):
        block = "```bash\n<!-- site: a -->\n[a](../../CHANGELOG.md)\n```\n"
        text = "Write `<!-- site: b -->`.\n\n"
        self.assertEqual(self.page(text + "<!-- run: no (a test) -->\n" + block).replace("\n\n\n", "\n\n"), text + block)

    def test_text_for_the_site_alone_is_shown(self):
        self.assertEqual(self.page("One.<!-- site:  Two [b](../faq.md). -->\n"), "One. Two [b](../faq.md).\n")

    def test_a_header_has_its_structs_with_fields_and_functions(self):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "s.xml").write_text(STRUCT, encoding="utf-8")
            text, about = cpp_reference.Pages(pathlib.Path(folder)).page("insonify/mesh.h")
        self.assertIn("triangle meshes", about)
        self.assertIn("## struct Box { #Box }\n\nA box.\n", text)
        self.assertIn('| <a id="Box.width" href="#Box.width">`std::vector<double> width`</a> `= {1.5}` | Across \\[m\\], of [Box](#Box). |\n', text)
        self.assertIn("### area() { #Box.area }\n\n```cpp\nconst double& area(int scale = 2) const;\n```\n\nIts area.\n", text)
        self.assertNotIn("delete", text)


if __name__ == "__main__":
    unittest.main()
