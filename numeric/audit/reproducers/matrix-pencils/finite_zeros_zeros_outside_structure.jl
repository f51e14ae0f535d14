# finite-zeros[zeros-outside]-structure: faults that no output shows are missed, or seen where there are none.
# Made by faultspace 0.1.0: faultspace audit --reproduce 'finite-zeros[zeros-outside]-structure' --language julia

using LinearAlgebra

failed = false
function told(what, got, expected, off, bound)
    wrong = any(.!(off .<= bound))
    global failed = failed || wrong
    println(what, ": ", wrong ? "WRONG" : "right", ", off by ", maximum(off), ", bound ", maximum(bound))
    println("  got      ", got, "\n  expected ", expected)
end

function nearest(got, expected)  # in the order of those of expected that they are nearest to
    left = collect(ComplexF64, got)
    return length(left) == length(expected) ? [splice!(left, argmin(abs.(left .- z))) for z in expected] : left
end
field(answer, name) = answer isa AbstractDict ? answer[String(name)] : getproperty(answer, name)

# -- how MatrixPencils.jl: spzeros, sprank is called
haskey(ENV, "MATRIX_PENCILS") && push!(LOAD_PATH, ENV["MATRIX_PENCILS"])
using LinearAlgebra, MatrixPencils

# The pencil [A - lambda I, F; C, G], tolerances by default. Its normal rank is that of the transfer function and n; an infinite elementary
# divisor of order k is an infinite zero of order k - 1, and `orders` has those above 0.
function structure(A, F, C, G)
    values, orders, _ = spzeros(A, I, F, C, G)
    rank = sprank(A, I, F, C, G) - size(A, 1)
    return (normal_rank = rank, finite_zeros = complex(filter(!isinf, values)),
            infinite_zero_orders = [zeros(Int, max(rank - length(orders), 0)); orders], left_invertible = rank == size(G, 2))
end


# -- the question
A = reshape([
    0.25 0.0 0.0
    1.875 0.75 0.0
    3.625 -0.25 0.5
], 3, 3)
F = reshape([
    1.0
    -0.5
    2.5
], 3, 1)
C = reshape([
    -6.0 0.5 1.0
    -0.75 4.0 2.0
    -7.5 -2.5 -0.5
], 3, 3)
G = reshape([
    -2.0
    -1.0
    -2.0
], 3, 1)
answer = try structure(A, F, C, G) catch problem; println("refused: ", problem); nothing end
if answer === nothing println("WRONG: an answer is due"); exit(1) end
expected = [complex(-2.5,0.0)]; bound = [1.1e-12]
got = field(answer, :finite_zeros)
got = nearest(got, expected)
same = length(got) == length(expected)
told("number of finite zeros", got, expected, same ? abs.(got - expected) : [Inf], same ? bound : [0.0])
exit(failed ? 1 : 0)
