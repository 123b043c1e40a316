// list_families FILE: writes the families of coordinates as a module of the add-on, which does not know the library.

#include <cctype>
#include <fstream>
#include <iomanip>

#include <vdbcage/deform/coordinates.h>

int main(int, char** argv)
{
    std::ofstream out(argv[1]);
    out << "# SPDX-License-Identifier: Apache-2.0 OR GPL-3.0-or-later\n"
           "\"\"\"The families of coordinates of vdbcage: name, title and description. The build writes this.\"\"\"\n\n"
           "FAMILIES = (\n";
    for (const vdbcage::FamilyInfo& family : vdbcage::coordinateFamilies()) {
        std::string what = family.what;
        what[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(what[0])));
        if (!family.isEverywhere) what += ". The model must be inside";
        out << "    (" << std::quoted(family.name) << ", " << std::quoted(family.title) << ", " << std::quoted(what)
            << "),\n";
    }
    out << ")\n";
    return out.flush() ? 0 : 1;
}
