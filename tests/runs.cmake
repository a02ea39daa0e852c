# Whole runs of the program: equal bits on any number of ranks and after restart, and what it says when a run cannot go on.
set(program $<TARGET_FILE:brisance>)
set(runs ${CMAKE_CURRENT_BINARY_DIR}/runs)
set(scenes ${PROJECT_SOURCE_DIR}/jobs/scenes)

# brisance_same_digest(name SCENE steps [options of run])
function(brisance_same_digest name scene steps)
  add_test(NAME same_digest.${name} COMMAND ${PROJECT_SOURCE_DIR}/tests/support/same_digest.sh ${program} ${runs}/${name}
                                            ${steps} ${scene} ${ARGN})
  set_tests_properties(same_digest.${name} PROPERTIES LABELS "parallel;restart" PROCESSORS 2 TIMEOUT 1500)
endfunction()
brisance_same_digest(explosion-cylinder ${scenes}/explosion-cylinder.toml 60)
brisance_same_digest(explosion-box-3d ${scenes}/explosion-box-3d.toml 24 --set fluid.block=24)
# The cases V1 to V13 of the coupling's theory and bodies in 3D; their figures are checked by verification/coupling.
brisance_same_digest(free-piston ${scenes}/free-piston.toml 20)
brisance_same_digest(body-in-common-motion ${scenes}/body-in-common-motion.toml 20 --set fluid.block=20)
brisance_same_digest(sliding-wall ${scenes}/sliding-wall.toml 20 --set fluid.block=20)
brisance_same_digest(spinning-cylinder ${scenes}/spinning-cylinder.toml 20 --set fluid.block=40)
brisance_same_digest(bodies-in-a-cell ${scenes}/bodies-in-a-cell.toml 4)
brisance_same_digest(shock-on-a-wedge ${scenes}/shock-on-a-wedge.toml 20 --set "fluid.cells=[80, 80]")
brisance_same_digest(double-mach-ramp ${scenes}/double-mach-ramp.toml 20 --set "fluid.cells=[130, 95]")
brisance_same_digest(cylinder-lift-off ${scenes}/cylinder-lift-off.toml 40 --set output.interval=0.003)
brisance_same_digest(panel-in-a-shock-tube ${scenes}/panel-in-a-shock-tube.toml 40 --set output.interval=2e-6
                     --set "fluid.low=[0.18, 0]" --set "fluid.high=[0.35, 0.08]" --set "fluid.cells=[170, 80]")
brisance_same_digest(elastic-shell ${scenes}/elastic-shell.toml 40)
brisance_same_digest(opening-crack ${scenes}/opening-crack.toml 20)
brisance_same_digest(free-expansion ${scenes}/free-expansion.toml 20)
brisance_same_digest(bursting-tube ${scenes}/bursting-tube.toml 60 --set "fluid.cells=[120, 120]" --set output.interval=1e-4)
brisance_same_digest(sphere-lift-off ${scenes}/sphere-lift-off.toml 8 --set "fluid.cells=[30, 12, 10]" --set fluid.block=10
                     --set output.interval=0.003)
brisance_same_digest(breaking-wall ${scenes}/breaking-wall.toml 60 --set output.interval=1e-4)
set_tests_properties(same_digest.breaking-wall PROPERTIES ENVIRONMENT BREAKING=1)
brisance_same_digest(bursting-sphere ${scenes}/bursting-sphere.toml 24 --set "fluid.cells=[24, 24, 24]" --set fluid.block=12)
brisance_same_digest(ledger-by-stages ${scenes}/colliding-fragments.toml 60 --set "fluid.cells=[50, 50]" --set end_time=0.3
                     --set "output.ledger=\"stage\"")
set_tests_properties(same_digest.ledger-by-stages PROPERTIES ENVIRONMENT BREAKING=1)
# Heat through the walls, friction in divided cells, weight of the gas; weight of the bodies.
brisance_same_digest(ledger-by-stages-viscous ${PROJECT_SOURCE_DIR}/tests/support/scenes/thin-plates.toml 20
                     --set "output.ledger=\"stage\"" --set "fluid.gravity.acceleration=[0, -1]")
brisance_same_digest(ledger-by-stages-heavy ${scenes}/colliding-fragments.toml 20 --set "fluid.cells=[50, 50]"
                     --set "output.ledger=\"stage\"" --set "solid.gravity=[0, -1]")
brisance_same_digest(bodies-apart ${PROJECT_SOURCE_DIR}/tests/support/scenes/bodies-apart.toml 40)
brisance_same_digest(thin-shell ${scenes}/thin-shell.toml 12)
brisance_same_digest(thin-plates ${PROJECT_SOURCE_DIR}/tests/support/scenes/thin-plates.toml 60)
brisance_same_digest(thin-plates-explicit ${PROJECT_SOURCE_DIR}/tests/support/scenes/thin-plates.toml 40
                     --set "coupling.scheme=\"explicit\"")
brisance_same_digest(thin-shell-viscous ${scenes}/thin-shell.toml 12 --set fluid.viscosity.dynamic_viscosity=2e-3
                     --set coupling.cut_cells.wall.temperature=0.002)
brisance_same_digest(thin-shell-density ${scenes}/thin-shell.toml 12 --set "coupling.cut_cells.profile=\"density\""
                     --set "coupling.cut_cells.small_cells=\"redistribution\"")
brisance_same_digest(held-wall ${PROJECT_SOURCE_DIR}/tests/support/scenes/held-wall.toml 80)
brisance_same_digest(bursting-shell ${scenes}/bursting-shell.toml 80)
brisance_same_digest(colliding-fragments ${scenes}/colliding-fragments.toml 330)
brisance_same_digest(blast-bricks ${scenes}/blast-bricks.toml 40 --set "fluid.cells=[24, 18, 12]" --set fluid.block=6)
# The other time couplings, and sub-steps of the solid: as its limits ask (bursting-shell), or as the scene says.
brisance_same_digest(bursting-explicit ${scenes}/bursting-shell.toml 60 --set "coupling.scheme=\"explicit\"")
brisance_same_digest(bursting-semi ${scenes}/bursting-shell.toml 40 --set "coupling.scheme=\"semi\"" --set coupling.sub_steps=2)
brisance_same_digest(colliding-explicit ${scenes}/colliding-fragments.toml 120 --set "fluid.cells=[50, 50]"
                     --set "coupling.scheme=\"explicit\"")
brisance_same_digest(sub-steps ${PROJECT_SOURCE_DIR}/tests/support/scenes/sub-steps.toml 24)
brisance_same_digest(sub-steps-explicit ${PROJECT_SOURCE_DIR}/tests/support/scenes/sub-steps.toml 24
                     --set "coupling.scheme=\"explicit\"")
brisance_same_digest(leave-explicit ${PROJECT_SOURCE_DIR}/tests/support/scenes/bodies-leave.toml 160
                     --set "coupling.scheme=\"explicit\"" --set coupling.sub_steps=2)
brisance_same_digest(viscous-explicit ${PROJECT_SOURCE_DIR}/tests/support/scenes/viscous-bodies.toml 40
                     --set "coupling.scheme=\"explicit\"" --set coupling.sub_steps=2)
brisance_same_digest(bodies-leave ${PROJECT_SOURCE_DIR}/tests/support/scenes/bodies-leave.toml 240)
brisance_same_digest(bodies-apart-density ${PROJECT_SOURCE_DIR}/tests/support/scenes/bodies-apart.toml 40
                     --set "coupling.cut_cells.profile=\"density\"" --set "coupling.cut_cells.small_cells=\"redistribution\"")
brisance_same_digest(bursting-shell-density ${scenes}/bursting-shell.toml 80 --set "coupling.cut_cells.profile=\"density\"")
brisance_same_digest(jwl-charge ${PROJECT_SOURCE_DIR}/tests/support/scenes/jwl-charge.toml 60)
brisance_same_digest(rejected-pairs ${PROJECT_SOURCE_DIR}/tests/support/scenes/rejected-pairs.toml 60)
brisance_same_digest(blast-in-a-box ${PROJECT_SOURCE_DIR}/tests/support/scenes/blast-in-a-box.toml 24)
brisance_same_digest(merged ${PROJECT_SOURCE_DIR}/tests/support/scenes/blast-in-a-box.toml 24
                     --set "fluid.euler.splitting=\"merged\"" --set fluid.euler.smooth=true)
brisance_same_digest(rejected-viscous ${PROJECT_SOURCE_DIR}/tests/support/scenes/rejected-pairs.toml 40
                     --set "fluid.viscosity.law=\"sutherland\"" --set "fluid.gravity.acceleration=[0, -9.81]")
brisance_same_digest(sides ${PROJECT_SOURCE_DIR}/tests/support/scenes/sides.toml 60)
brisance_same_digest(double-mach ${PROJECT_SOURCE_DIR}/tests/support/scenes/double-mach.toml 40)
brisance_same_digest(viscous-box ${PROJECT_SOURCE_DIR}/tests/support/scenes/viscous-box.toml 40)
brisance_same_digest(viscous-bodies ${PROJECT_SOURCE_DIR}/tests/support/scenes/viscous-bodies.toml 60)
brisance_same_digest(solid-only ${PROJECT_SOURCE_DIR}/tests/support/scenes/solid-only.toml 60)
brisance_same_digest(ductile ${PROJECT_SOURCE_DIR}/tests/support/scenes/ductile.toml 80)
brisance_same_digest(consistent ${PROJECT_SOURCE_DIR}/tests/support/scenes/consistent.toml 80)
brisance_same_digest(bursting-wheel ${scenes}/bursting-wheel.toml 80 --set solid.body.0.particles=300)
brisance_same_digest(break-up ${PROJECT_SOURCE_DIR}/tests/support/scenes/break-up.toml 44)
brisance_same_digest(clash ${PROJECT_SOURCE_DIR}/tests/support/scenes/clash.toml 80)
set_tests_properties(same_digest.clash PROPERTIES ENVIRONMENT BREAKING=1)
brisance_same_digest(rods-and-plates ${PROJECT_SOURCE_DIR}/tests/support/scenes/rods-and-plates.toml 120)
brisance_same_digest(two-bars ${scenes}/two-bars.toml 40)
brisance_same_digest(filled-surfaces ${PROJECT_SOURCE_DIR}/tests/support/scenes/filled-surfaces.toml 40)
brisance_same_digest(supports ${PROJECT_SOURCE_DIR}/tests/support/scenes/supports.toml 120)
brisance_same_digest(paddle ${PROJECT_SOURCE_DIR}/tests/support/scenes/paddle.toml 40)
brisance_same_digest(kinetic ${PROJECT_SOURCE_DIR}/tests/support/scenes/supports.toml 120
                     --set "solid.damping={law=\"kinetic\", residual=1e-3}")
brisance_same_digest(loads ${PROJECT_SOURCE_DIR}/tests/support/scenes/loads.toml 60)
brisance_same_digest(blast-plate ${scenes}/blast-plate.toml 80)
brisance_same_digest(brick-wall ${scenes}/brick-wall.toml 200 --set output.interval=1 --set "solid.body.1.velocity=[60, 0, 0]")
brisance_same_digest(struck-bar ${PROJECT_SOURCE_DIR}/tests/support/scenes/struck-bar.toml 40)
brisance_same_digest(multirate ${PROJECT_SOURCE_DIR}/tests/support/scenes/graded-bar.toml 40)
brisance_same_digest(sharp-step ${PROJECT_SOURCE_DIR}/tests/support/scenes/solid-only.toml 20
                     --set "solid.motion.step=\"sharp\"")

# brisance_same_gauges(name SCENE steps [options of run])
function(brisance_same_gauges name scene steps)
  add_test(NAME same_gauges.${name} COMMAND ${PROJECT_SOURCE_DIR}/tests/support/same_gauges.sh ${program} ${runs}/gauges-${name}
                                            ${steps} ${scene} ${ARGN})
  set_tests_properties(same_gauges.${name} PROPERTIES LABELS "parallel;restart" PROCESSORS 2 TIMEOUT 600)
endfunction()
brisance_same_gauges(gauges ${PROJECT_SOURCE_DIR}/tests/support/scenes/gauges.toml 160)
brisance_same_gauges(supports ${PROJECT_SOURCE_DIR}/tests/support/scenes/supports.toml 120)
brisance_same_gauges(paddle ${PROJECT_SOURCE_DIR}/tests/support/scenes/paddle.toml 40)
brisance_same_gauges(merged ${PROJECT_SOURCE_DIR}/tests/support/scenes/gauges-in-a-box.toml 24)
brisance_same_gauges(rejected-pairs ${PROJECT_SOURCE_DIR}/tests/support/scenes/rejected-pairs.toml 40)
brisance_same_gauges(explosion-box-3d ${scenes}/explosion-box-3d.toml 12 --set fluid.block=32 --set output.interval=1e-5
                     --set "output.fields=[\"schlieren\", \"vorticity\"]" --set output.gauge.0.interval=1e-6 --set output.gauge.1.interval=1e-6)

# Faults of bodies and ranks: scene errors, nothing written.
foreach(fault overlapping-bodies non-convex-cells)
  set(scene ${PROJECT_SOURCE_DIR}/tests/support/scenes/${fault}.toml)
  set(says_overlapping-bodies "overlapping-bodies.toml:14:1: .*left.*right.*overlap by")
  set(says_non-convex-cells "non-convex-cells.toml:12:1: .*cell 0 is not convex at")
  brisance_expect(scene_${fault} CODE 2 LABELS unit MESSAGE "${says_${fault}}" ABSENT ${runs}/${fault}
                  COMMAND ${program} run ${scene} --out ${runs}/${fault})
endforeach()
brisance_expect(scene_no_face_loaded CODE 2 LABELS unit ABSENT ${runs}/unloaded
                MESSAGE "loads.toml:[0-9]+:[0-9]+: solid.traction.0. selects no face: none of the .* of solid.body .block."
                COMMAND ${program} run ${PROJECT_SOURCE_DIR}/tests/support/scenes/loads.toml --out ${runs}/unloaded
                        --set "solid.traction.0.normal=[0, 0, -1]")
brisance_expect(scene_blast_too_far CODE 2 LABELS unit ABSENT ${runs}/far
                MESSAGE "blast-plate.toml:[0-9]+:[0-9]+: solid.blast.0.: a face at .* published from 0.147 to 40"
                COMMAND ${program} run ${scenes}/blast-plate.toml --out ${runs}/far --set "solid.blast.0.mass=1e-6")
brisance_expect(scene_wall_leaves_its_cell CODE 2 LABELS unit ABSENT ${runs}/wall
                MESSAGE "sides.toml:[0-9]+:[0-9]+: fluid.boundary.y_low is a wall that moves by"
                COMMAND ${program} run ${PROJECT_SOURCE_DIR}/tests/support/scenes/sides.toml --out ${runs}/wall
                        --set end_time=20)
brisance_expect(scene_multirate_with_cut_cells CODE 2 LABELS unit ABSENT ${runs}/multirate-cut
                MESSAGE "solid.motion.multirate does not go together with coupling.cut_cells"
                COMMAND ${program} run ${scenes}/explosion-cylinder.toml --out ${runs}/multirate-cut
                        --set solid.motion.multirate.levels=2)
brisance_expect(scene_multirate_with_sharp_step CODE 2 LABELS unit ABSENT ${runs}/multirate-sharp
                MESSAGE "solid.motion.multirate needs the limit of every particle"
                COMMAND ${program} run ${PROJECT_SOURCE_DIR}/tests/support/scenes/graded-bar.toml --out ${runs}/multirate-sharp
                        --set "solid.motion.step=\"sharp\"")
brisance_expect(summary_solid_sleep CODE 0 LABELS unit MESSAGE "\"link_updates_skipped\": [1-9]"
                COMMAND bash -c "$<TARGET_FILE:brisance> run ${PROJECT_SOURCE_DIR}/tests/support/scenes/struck-bar.toml \
--out ${runs}/solid-sleep --steps 20 --quiet && cat ${runs}/solid-sleep/summary.json")
# Cells of a thin wall whose parts cannot be followed are counted, the same on any number of ranks, and told of.
foreach(ranks 1 3)
  brisance_expect(summary_mixed_divided_cells_${ranks} CODE 0 RANKS ${ranks} LABELS unit
                  MESSAGE "a thin wall leaked within a cell: 1 time.*\"mixed_divided_cells\": 1,"
                  COMMAND bash -c "$<TARGET_FILE:brisance> run ${scenes}/bursting-shell.toml --out ${runs}/mixed-${ranks} \
--steps 80 --quiet && cat ${runs}/mixed-${ranks}/summary.json")
endforeach()
brisance_expect(check_multirate CODE 0 LABELS unit MESSAGE "multi-rate steps.*4 levels, [12][.0-9]+ times fewer links"
                COMMAND ${program} check ${PROJECT_SOURCE_DIR}/tests/support/scenes/graded-bar.toml)
brisance_expect(scene_more_ranks_than_blocks CODE 2 RANKS 3 LABELS parallel ABSENT ${runs}/ranks
                MESSAGE "explosion-cylinder.toml:[0-9]+:[0-9]+: 3 ranks, but the scene has only 2 fluid blocks"
                COMMAND ${program} run ${scenes}/explosion-cylinder.toml --out ${runs}/ranks --set fluid.block=300)
brisance_expect(scene_fracture_without_links CODE 2 LABELS unit ABSENT ${runs}/no-links
                MESSAGE "solid.fracture breaks links, and the scene has none"
                COMMAND ${program} run ${PROJECT_SOURCE_DIR}/tests/support/scenes/free-particles.toml --out ${runs}/no-links)
brisance_expect(check_bursting-wheel CODE 0 LABELS unit MESSAGE "solid.fracture +on.*300 particles.*warning: the softening zone of 0.0521 m"
                COMMAND ${program} check ${scenes}/bursting-wheel.toml --ranks 2 --set solid.body.0.particles=300)
brisance_expect(run_rods-and-plates CODE 0 LABELS verification
                MESSAGE "momentum [0-9.]+e-1[4-9], exchange energy 0.0e.00, energy [0-9.]+e-0[7-9]"
                COMMAND ${program} run ${PROJECT_SOURCE_DIR}/tests/support/scenes/rods-and-plates.toml --out ${runs}/rods-and-plates-whole)
brisance_expect(check_explosion-cylinder CODE 0 LABELS unit MESSAGE "coupling.cut_cells +on.*180000 cells.*50 particles, 50 links"
                COMMAND ${program} check ${scenes}/explosion-cylinder.toml --ranks 4)
brisance_expect(check_explosion-box-3d CODE 0 LABELS unit MESSAGE "solid.gravity +off: .*output.gauges +on.*416 particles.*charges +fluid.charge.0.: 1 kg of gas with 4.184 MJ above"
                COMMAND ${program} check ${scenes}/explosion-box-3d.toml --ranks 2)
brisance_expect(check_two-bars CODE 0 LABELS unit
                MESSAGE "bar: 976 particles; worst angle .* a patch of 600 of them at nu = 0.33: E .[0-9.]+ %.*warning: a face of particle [0-9]+ at .*allows the shortest step"
                COMMAND ${program} check ${scenes}/two-bars.toml)
brisance_expect(mesh_group_missing CODE 2 LABELS unit ABSENT ${runs}/no-group
                MESSAGE "two-bars.toml:[0-9]+:[0-9]+: solid.body .bar.: .*meshes/two-bars.msh: no element is in a physical volume .copper.. Physical volumes: aluminium, steel"
                COMMAND ${program} run ${scenes}/two-bars.toml --out ${runs}/no-group --set "solid.body.0.mesh.group=\"copper\"")

brisance_expect(check_brick-wall CODE 0 LABELS unit MESSAGE "solid.contact +on.*contact +solid.contact.*372 particles, 828 links"
                COMMAND ${program} check ${scenes}/brick-wall.toml --ranks 2)
brisance_expect(scene_unknown_scheme CODE 2 LABELS unit ABSENT ${runs}/no-scheme
                MESSAGE "coupling.scheme = .implicit. is not known.*lag, semi, explicit"
                COMMAND ${program} run ${scenes}/explosion-cylinder.toml --out ${runs}/no-scheme --set "coupling.scheme=\"implicit\"")
brisance_expect(check_light_solid CODE 0 LABELS unit
                MESSAGE "light solid: particle [0-9]+ of body .tube. .*Steps are limited to this share"
                COMMAND ${program} check ${scenes}/explosion-cylinder.toml --set "solid.material.steel.density=0.1")
brisance_expect(check_sleep CODE 0 LABELS unit MESSAGE "fluid.sleep +off: all blocks are swept"
                COMMAND ${program} check ${scenes}/explosion-cylinder.toml --set fluid.sleep=false)

brisance_expect(scene_consistent_breaks CODE 2 LABELS unit ABSENT ${runs}/consistent-breaks
                MESSAGE "break-up.toml:[0-9]+:[0-9]+: .*volumetric = .consistent. needs links that stay whole"
                COMMAND ${program} run ${PROJECT_SOURCE_DIR}/tests/support/scenes/break-up.toml --out ${runs}/consistent-breaks
                        --set "solid.links.volumetric=\"consistent\"")

# Truncated checkpoints and a full disk.
add_test(NAME truncated_checkpoint COMMAND ${PROJECT_SOURCE_DIR}/tests/support/truncated_checkpoint.sh ${program}
                                           ${runs}/truncated ${scenes}/explosion-cylinder.toml)
add_test(NAME full_disk COMMAND ${PROJECT_SOURCE_DIR}/tests/support/full_disk.sh ${program} ${runs}/full
                                ${scenes}/explosion-cylinder.toml)
add_test(NAME stop_by_signal COMMAND ${PROJECT_SOURCE_DIR}/tests/support/stop_by_signal.sh ${program} ${runs}/signal
                                     ${scenes}/explosion-cylinder.toml)
add_test(NAME fresh_run COMMAND ${PROJECT_SOURCE_DIR}/tests/support/fresh_run.sh ${program} ${runs}/fresh
                                ${PROJECT_SOURCE_DIR}/tests/support/scenes/bodies-apart.toml)
set_tests_properties(truncated_checkpoint full_disk stop_by_signal fresh_run PROPERTIES LABELS restart TIMEOUT 300)

# A limit of the law stops the run and says which particle, why, and what to do.
brisance_expect(overstrained CODE 3 LABELS stability
                MESSAGE "plastic strain of particle [0-9]+ at .* has passed 0.9.*failure strain.*step [0-9]+, t = "
                COMMAND ${program} run ${PROJECT_SOURCE_DIR}/tests/support/scenes/overstrained.toml --out ${runs}/overstrained)
