# finite-zeros[zeros-outside]-structure: faults that no output shows are missed, or seen where there are none.
#
# How it is compared: As many as there are true ones. Pair each true number with one of the answer's, so that
# none is used twice and the sum of distances is least; each is within its bound.
#
# Made by faultspace 0.1.0: faultspace audit --reproduce 'finite-zeros[zeros-outside]-structure' --language
# julia

using LinearAlgebra

failed = false
function told(what, got, expected, off, bound)
    wrong = any(.!(off .<= bound))
    global failed = failed || wrong
    println(what, ": ", wrong ? "WRONG" : "right")
    println("  got      ", got, "\n  expected ", expected)
    println("  off by ", maximum(off), ", largest ratio to the bound ", maximum(off ./ max.(bound, floatmin())))
end
function nearest(got, expected)  # in the order of those of expected that they are nearest to
    left = collect(ComplexF64, got)
    return length(left) == length(expected) ? [splice!(left, argmin(abs.(left .- z))) for z in expected] : left
end
basis(M) = (F = svd(M / max(mapreduce(abs, max, M; init = 0.0), floatmin())); F.U[:, F.S .> 1e-12 * reduce(max, F.S; init = 0.0)])
angle_of(P, Q) = size(P) == size(Q) ? opnorm(P - Q * (Q' * P)) : 1.0
sine(got, expected) = angle_of(basis(got), basis(expected))  # of the largest angle, 1 for unlike dimensions
matrix(x) = x isa AbstractMatrix ? x : reshape(collect(x), :, 1)
field(answer, name) = answer isa AbstractDict ? answer[String(name)] : getproperty(answer, name)
function stacked(first, C, A, B, rows)
    got = first
    while size(got, 1) < rows
        got = [got; C * B]; B = A * B
    end
    return got
end
seen(row, off) = norm(sum(off[k:end-size(row, 1)+k, :] * row[k, :] for k in axes(row, 1)))
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

expected = reshape([
    complex(-2.5,0.0)
], 1, 1)
bound = reshape([
    1.1e-12
], 1, 1)
got = field(answer, :finite_zeros)
got = nearest(got, vec(expected))
same = length(got) == length(expected)
told("number of finite zeros", got, vec(expected), same ? abs.(got - vec(expected)) : [Inf], same ? vec(bound) : [0.0])

exit(failed ? 1 : 0)
