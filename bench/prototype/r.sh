# r.sh MODEL BASE LEVEL
M=/work/shared/meshes/paper
case $1 in horse) f=horse_48485;; venus) f=venus_50002;; bunny) f=bunny_34835_69473;; feline) f=feline_49864;; esac
./${LAB:-lab2} maps/$1_$2.param.ply $M/$f.ply $3 2>/dev/null
