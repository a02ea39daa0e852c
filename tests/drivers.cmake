brisance_test(drivers_test SOURCES unit/drivers/times_test.cpp unit/drivers/scene_test.cpp LINKS brisance::drivers LABELS unit)
brisance_test(stage_ledger SOURCES verification/stage_ledger_test.cpp LINKS brisance::drivers RANKS 1 3
              LABELS "verification;parallel")
brisance_test(contact_in_sub_steps SOURCES verification/contact_in_sub_steps_test.cpp LINKS brisance::drivers
              LABELS verification)

# One message and one exit code, whoever fails.
add_executable(guard_probe support/guard_probe.cpp)
target_link_libraries(guard_probe PRIVATE brisance::drivers)
foreach(ranks 1 2 3)
  brisance_expect(guard_all_fail.${ranks}ranks CODE 3 RANKS ${ranks} LABELS parallel
                  MESSAGE "brisance: error: cell 7 has no density" COMMAND $<TARGET_FILE:guard_probe> all)
  brisance_expect(guard_passes_codes.${ranks}ranks CODE 75 RANKS ${ranks} LABELS parallel MESSAGE ""
                  COMMAND $<TARGET_FILE:guard_probe> none)
endforeach()
brisance_expect(guard_one_fails.3ranks CODE 4 RANKS 3 LABELS parallel MESSAGE "error on rank 2 alone: disk full"
                COMMAND $<TARGET_FILE:guard_probe> last)
brisance_expect(guard_internal CODE 1 LABELS unit MESSAGE "internal error: a bug" COMMAND $<TARGET_FILE:guard_probe> internal)

# The command line, end to end.
set(brisance $<TARGET_FILE:brisance>)
set(work ${CMAKE_CURRENT_BINARY_DIR}/command_line)

brisance_expect(usage_no_command CODE 2 LABELS unit MESSAGE "subcommand is required" COMMAND ${brisance})
brisance_expect(usage_unknown_command CODE 2 LABELS unit MESSAGE "no subcommand rnu, the nearest is run" COMMAND ${brisance} rnu)
brisance_expect(usage_unknown_option CODE 2 LABELS unit MESSAGE "--fats" COMMAND ${brisance} run x.toml --fats)
brisance_expect(usage_wrong_walltime CODE 2 LABELS unit MESSAGE "--walltime .soon. is not a time; expected one such as 1h50m"
                ABSENT ${work}/out_walltime COMMAND ${brisance} run x.toml --out ${work}/out_walltime --walltime soon)
brisance_expect(usage_wrong_until CODE 2 LABELS unit MESSAGE "--until .1 kg.: 'kg' has the wrong dimension"
                COMMAND ${brisance} run x.toml --until "1 kg")
brisance_expect(usage_wrong_steps CODE 2 LABELS unit MESSAGE "--steps: -3 is not a whole number from 1 on" COMMAND ${brisance} run x.toml --steps=-3)
foreach(command run restart check bench params)
  brisance_expect(help_${command} CODE 0 LABELS unit MESSAGE "Usage: brisance ${command}" COMMAND ${brisance} ${command} --help)
endforeach()
brisance_expect(help CODE 0 LABELS unit MESSAGE "run.*restart.*check.*bench.*params.*Exit codes" COMMAND ${brisance} --help)
brisance_expect(version CODE 0 LABELS unit MESSAGE "brisance ${PROJECT_VERSION}" COMMAND ${brisance} --version)

brisance_expect(params_all CODE 0 LABELS unit COMMAND ${brisance} params
                MESSAGE "end_time.*output.interval.*output.gauge.*position.*fluid.euler.order.*solid.material.NAME.density.*solid.body\\[\\].shape.*coupling.cut_cells.small_cell")
brisance_expect(params_one CODE 0 LABELS unit COMMAND ${brisance} params fluid.euler.order
                MESSAGE "^fluid.euler.order +type: an integer, one of 1, 3, 5, 7, 9, 11; unit: -; default: 5")
brisance_expect(params_unknown CODE 2 LABELS unit MESSAGE "no key fluid.eular; the nearest known key is fluid.euler"
                COMMAND ${brisance} params fluid.eular)

# scene_fault(name regex text): `run` and `check` of this scene end with code 2 and this message, and write nothing.
function(scene_fault name regex text)
  file(WRITE ${work}/${name}.toml "${text}")
  brisance_expect(scene_${name} CODE 2 LABELS unit MESSAGE "${regex}" ABSENT ${work}/out_${name}
                  COMMAND ${brisance} run ${work}/${name}.toml --out ${work}/out_${name})
  brisance_expect(check_${name} CODE 2 LABELS unit MESSAGE "${regex}" COMMAND ${brisance} check ${work}/${name}.toml)
endfunction()
set(gas "end_time = \"1 ms\"\n[fluid]\nhigh = [\"1 m\"]\ncells = [16]\n")
scene_fault(unknown_key "unknown_key.toml:6:1: unknown key fluid.eular; the nearest known key is fluid.euler "
            "${gas}ambient = { density = 1 }\neular = { order = 5 }\n")
scene_fault(wrong_unit "wrong_unit.toml:5:25: fluid.ambient.density = .1.2 kg.: 'kg' has the wrong dimension; expected a number in kg/m3"
            "${gas}ambient = { density =   \"1.2 kg\" }\n")
scene_fault(wrong_type "wrong_type.toml:5:19: fluid.euler.order = .five. is a string; expected an integer, one of 1, 3, 5, 7, 9, 11"
            "${gas}euler = { order = \"five\" }\n")
scene_fault(out_of_range "out_of_range.toml:5:17: fluid.euler.cfl = 1.5 is out of range; expected a number, above 0"
            "${gas}euler = { cfl = 1.5 }\n")
set(wall "[solid.material.steel]\ndensity = 7800\nyoung_modulus = 2e11\npoisson_ratio = 0.3\n[[solid.body]]\nmaterial = \"steel\"\nshape = \"box\"\nlow = [0.4, 0.4]\nhigh = [0.6, 0.6]\ncells = [1, 1]\n[coupling]\ncut_cells = {}\n")
scene_fault(products_beside_solid "products_beside_solid.toml:5:12: fluid.products: cut cells do not carry products yet"
            "end_time = 1\n[fluid]\nhigh = [1, 1]\ncells = [16, 16]\nproducts = {}\neuler = {}\n${wall}")
scene_fault(missing_key "missing_key.toml:2:1: fluid.cells is missing; expected" "end_time = 1\n[fluid]\nhigh = [1]\n")
scene_fault(merged_gravity "merged_gravity.toml:5:9: fluid.euler.splitting = .merged. has no whole steps, which fluid.gravity acts between"
            "end_time = 1\n[fluid]\nhigh = [1, 1]\ncells = [16, 16]\neuler = { splitting = \"merged\" }\ngravity = { acceleration = [0, \"-9.81 m/s2\"] }\n")
scene_fault(not_toml "not_toml.toml:1:[0-9]+: not valid TOML" "end_time = = 1\n")
scene_fault(lonely_coupling ": .coupling. needs both .fluid. and .solid.; .solid. is missing" "${gas}[coupling]\n")
scene_fault(gauge_outside "gauge_outside.toml:5:1: output.gauge .far. stands at x = 2 m, outside the grid, which reaches from 0 to 1 m"
            "${gas}[[output.gauge]]\nname = \"far\"\nposition = [2]\ninterval = 1e-5\n")
scene_fault(gauge_in_a_body "gauge_in_a_body.toml:2:1: output.gauge .deep. stands inside solid.body .block.: move it into the gas"
            "end_time = 1\n[[output.gauge]]\nname = \"deep\"\nposition = [0.5, 0.5]\ninterval = 1e-5\n[fluid]\nhigh = [1, 1]\ncells = [16, 16]\neuler = {}
[solid]\n[solid.material.m]\ndensity = 1000\nyoung_modulus = 1e9\n[[solid.body]]\nname = \"block\"\nmaterial = \"m\"\nlow = [0.3, 0.3]
high = [0.6, 0.6]\n[coupling]\ncut_cells = {}\n")
scene_fault(wrong_field "wrong_field.toml:.*output.fields.0. = .presure. is not known; .* the nearest is .pressure."
            "${gas}[output]\nfields = [\"presure\"]\n")
scene_fault(field_twice "output.fields lists .density. twice" "${gas}[output]\nfields = [\"density\", \"density\"]\n")
scene_fault(overdetermined_charge "overdetermined_charge.toml:5:1: fluid.charge.0.: .mass., .energy. and .tnt_factor. overdetermine it"
            "${gas}[[fluid.charge]]\ncentre = [0.5]\nradius = 0.1\nmass = 1\nenergy = 1e6\ntnt_factor = 1.2\n")
brisance_expect(scene_missing_file CODE 2 LABELS unit MESSAGE "no/such.toml: the scene cannot be read: No such file"
                ABSENT ${work}/out_missing COMMAND ${brisance} run no/such.toml --out ${work}/out_missing)
file(WRITE ${work}/good.toml "${gas}")
brisance_expect(scene_wrong_override CODE 2 LABELS unit ABSENT ${work}/out_override
                MESSAGE "--set fluid.euler.order=4: fluid.euler.order = 4 is out of range; expected an integer, one of 1, 3"
                COMMAND ${brisance} run ${work}/good.toml --out ${work}/out_override --set fluid.euler.order=4)
brisance_expect(scene_fault.3ranks CODE 2 RANKS 3 LABELS parallel MESSAGE "^[^:]*brisance: error: [^:]*good.toml:2:1: [^:]*$|fluid.euler.order = 4 is"
                COMMAND ${brisance} run ${work}/good.toml --out ${work}/out_override --set fluid.euler.order=4)

# Supports, damping and gauges of the solid.
set(body "end_time = 1\n[solid]\nlinks = {}\n[solid.material.m]\ndensity = 1\nyoung_modulus = 1\n[[solid.body]]\nname = \"b\"\nmaterial = \"m\"\nlow = [0, 0, 0]\nhigh = [2, 1, 1]\ncells = [2, 1, 1]\n")
scene_fault(history_descends "history_descends.toml:13:[0-9]+: .*body .b.: prescribed.history: its times must ascend, but 1.* s comes after 2"
            "${body}prescribed = [{ low = [0, 0, 0], high = [1, 1, 1], history = [{ time = 2 }, { time = 1 }] }]\n")
scene_fault(turn_without_centre "turn_without_centre.toml:13:[0-9]+: .*clamp turns: give the point about which it does as .centre."
            "${body}clamp = [{ low = [0, 0, 0], high = [0, 1, 1], spin = [1, 0, 0] }]\n")
scene_fault(two_motions "two_motions.toml:13:[0-9]+: .*clamp: give either a constant .velocity. and .spin. or a .history. of them"
            "${body}clamp = [{ low = [0, 0, 0], high = [0, 1, 1], velocity = [1, 0, 0], history = [{ time = 0 }] }]\n")
scene_fault(periodic_alone "periodic_alone.toml:7:1: .*body .b. is periodic along y with one cell, which would be its own neighbour: take at least 2"
            "${body}periodic = [\"y\"]\n")
scene_fault(periodic_voronoi "periodic_voronoi.toml:7:1: .*only a box of cartesian cells can be periodic"
            "${body}periodic = [\"x\"]\ntessellation = \"voronoi\"\n")
scene_fault(gradient_of_four "gradient_of_four.toml:13:[0-9]+: .*initial_velocity.gradient needs 9 numbers, row by row, and has 4"
            "${body}initial_velocity = [{ gradient = [1, 2, 3, 4] }]\n")
scene_fault(damping_without_rate "damping_without_rate.toml:13:[0-9]+: solid.damping: viscous damping needs a .rate., in 1/s"
            "${body}[solid.damping]\nuntil = 1\n")
scene_fault(kinetic_with_rate "kinetic_with_rate.toml:13:[0-9]+: solid.damping: kinetic damping has no .rate."
            "${body}[solid.damping]\nlaw = \"kinetic\"\nrate = 1\n")
set(gas_and_half "end_time = 1\n[fluid]\nhigh = [1, 1]\ncells = [16, 16]\neuler = {}\n[coupling]\ncut_cells = {}\n[solid]\nlinks = {}\n[solid.material.m]\ndensity = 1\nyoung_modulus = 1\n[[solid.body]]\nmaterial = \"m\"\nlow = [0.4, 0]\nhigh = [0.6, 0.4]\ncells = [2, 2]\n")
scene_fault(mirror_in_gas "mirror_in_gas.toml:8:1: coupling.cut_cells: the gas would press on the faces that lie on a plane of symmetry"
            "${gas_and_half}symmetry = [{ low = [0, 0], high = [1, 0] }]\n")
scene_fault(periodic_in_gas "periodic_in_gas.toml:8:1: coupling.cut_cells: a periodic body has no closed surface"
            "${gas_and_half}periodic = [\"x\"]\n")
function(solid_gauge_fault name regex keys)
  scene_fault(${name} "${regex}" "${body}[[output.solid_gauge]]\nname = \"g\"\ninterval = 1\n${keys}")
endfunction()
solid_gauge_fault(gauge_of_nothing "gauge_of_nothing.toml:13:1: output.solid_gauge .g.: no support lies in its box" "watch = \"support\"\n")
solid_gauge_fault(gauge_nowhere "gauge_nowhere.toml:13:1: output.solid_gauge .g. needs a .position." "")
solid_gauge_fault(gauge_no_normal "gauge_no_normal.toml:13:1: .*a section needs the .normal. of its plane" "watch = \"section\"\nposition = [1, 0, 0]\n")
solid_gauge_fault(gauge_beside "gauge_beside.toml:13:1: .*its plane cuts no link" "watch = \"section\"\nposition = [5, 0, 0]\nnormal = [1, 0, 0]\n")
solid_gauge_fault(gauge_no_body "gauge_no_body.toml:13:1: .*there is no body .c.; the nearest name is .b." "position = [0, 0, 0]\nbody = \"c\"\n")
