# julia --startup-file=no matrix_pencils.jl: spzeros and sprank of MatrixPencils.jl, behind JSON lines. See PROTOCOL.md.
haskey(ENV, "MATRIX_PENCILS") && push!(LOAD_PATH, ENV["MATRIX_PENCILS"])
using LinearAlgebra, MatrixPencils
include(joinpath(@__DIR__, "json_lines.jl"))

# The pencil [A - lambda I, F; C, G], tolerances by default. Its normal rank is that of the transfer function and n; an infinite elementary
# divisor of order k is an infinite zero of order k - 1, and `orders` has those above 0.
function structure(A, F, C, G)
    values, orders, _ = spzeros(A, I, F, C, G)
    rank = sprank(A, I, F, C, G) - size(A, 1)
    return (normal_rank = rank, finite_zeros = complex(filter(!isinf, values)),
            infinite_zero_orders = [zeros(Int, max(rank - length(orders), 0)); orders], left_invertible = rank == size(G, 2))
end

answer_questions((structure = structure,), """{"call": "structure", "A": [[0, 1], [2, 3]], "F": [[0], [1]], "C": [[4, 5]], "G": [[0]]}""")
