brisance_test(cut_geometry SOURCES unit/cut_geometry.cpp LINKS brisance::coupling LABELS unit)
brisance_test(cut_geometry_fuzz SOURCES unit/cut_geometry_fuzz.cpp LINKS brisance::coupling LABELS unit)
brisance_test(geometry_identities SOURCES verification/geometry_identities.cpp LINKS brisance::coupling LABELS verification)
brisance_test(cut_geometry_exact SOURCES unit/cut_geometry_exact.cpp LINKS brisance::coupling CGAL::CGAL LABELS unit)
